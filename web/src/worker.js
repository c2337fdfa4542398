// A worker that decodes files for a page: each message is a call of Session, answered in order.

import { Session, transfers } from "./session.js";

const sessions = new Map();

const calls = {
  async open({ id, module, options }) {
    sessions.set(id, await Session.create(module, options));
    return {};
  },
  step: ({ id, bytes, last }) => sessions.get(id).step(bytes, last),
  close({ id }) {
    sessions.get(id)?.close();
    sessions.delete(id);
    return {};
  },
};

self.onmessage = async ({ data }) => {
  try {
    const answer = await calls[data.call](data);
    self.postMessage({ id: data.id, answer }, transfers(answer.update));
  } catch (error) {
    self.postMessage({ id: data.id, failure: { code: error.code ?? "over limit", message: error.message } });
  }
};

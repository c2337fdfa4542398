// A static web server on 127.0.0.1 for the tests of the page, with the faults that real ones have.

import { createReadStream, existsSync, statSync } from "node:fs";
import { createServer } from "node:http";
import { join, normalize } from "node:path";
import { Transform } from "node:stream";

const types = { html: "text/html", js: "text/javascript", css: "text/css", json: "application/json", pstrip: "model/vnd.pstrips" };

// Lets `bytesPerSecond` through, in pieces of a fiftieth of a second.
function throttle(bytesPerSecond) {
  const piece = Math.max(256, Math.floor(bytesPerSecond / 50));
  return new Transform({
    async transform(chunk, _, done) {
      for (let at = 0; at < chunk.length; at += piece) {
        this.push(chunk.subarray(at, at + piece));
        await new Promise((resolve) => setTimeout(resolve, (1000 * Math.min(piece, chunk.length - at)) / bytesPerSecond));
      }
      done();
    },
  });
}

// roots: folders, by the first part of the path. Query: speed=BYTES_PER_SECOND, cut=BYTES (then the
// connection breaks), flip=BYTE (which is spoilt), status=CODE.
export async function serve(roots) {
  const server = createServer((request, response) => {
    const url = new URL(request.url, "http://127.0.0.1");
    const [, root, ...rest] = decodeURIComponent(url.pathname).split("/");
    const path = roots[root] && join(roots[root], normalize(rest.join("/")));
    const number = (name) => Number(url.searchParams.get(name));
    if (number("status") || !path || !existsSync(path) || !statSync(path).isFile()) {
      response.writeHead(number("status") || 404).end();
      return;
    }
    const size = statSync(path).size, end = number("cut") || size;
    response.writeHead(200, {
      "content-type": types[path.split(".").pop()] ?? "application/octet-stream", "content-length": size,
    });
    let sent = 0;
    const spoil = new Transform({
      transform(chunk, _, done) {
        const flip = number("flip") - sent;
        if (flip > 0 && flip < chunk.length) chunk[flip] ^= 0xff;
        sent += chunk.length;
        done(null, chunk);
      },
    });
    let stream = createReadStream(path, { end: end - 1 }).pipe(spoil);
    if (number("speed")) stream = stream.pipe(throttle(number("speed")));
    stream.on("data", (chunk) => response.write(chunk));
    stream.on("end", () => (end < size ? response.destroy() : response.end()));
    response.on("close", () => stream.destroy());
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  return { origin: `http://127.0.0.1:${server.address().port}`, close: () => server.close() };
}

#include "cli/page_server.h"

#include <fmt/format.h>
#include <httplib.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <thread>

namespace pstrips::cli {
namespace {

constexpr const char* kHost = "127.0.0.1";
constexpr const char* kFileType = "model/vnd.pstrips";
/// Pieces a second in which a slow link delivers.
constexpr double kPieces = 50;

/// Bytes of a name that a path of a URL may not hold as they are become %XX.
std::string url_of(std::string_view name) {
  std::string out;
  for (const char c : name) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '.' ||
                       c == '_' || c == '~';
    out += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return out;
}

void send(const Bytes& bytes, double bytes_a_second, httplib::Response& response) {
  const auto give = [&bytes, bytes_a_second](std::size_t offset, std::size_t length,
                                             httplib::DataSink& sink) {
    const auto* const from = reinterpret_cast<const char*>(bytes.data()) + offset;
    if (bytes_a_second <= 0) return sink.write(from, length);
    const auto piece = static_cast<std::size_t>(std::max(1.0, bytes_a_second / kPieces));
    const std::size_t now = std::min(length, piece);
    if (!sink.write(from, now)) return false;
    std::this_thread::sleep_for(
        std::chrono::duration<double>(static_cast<double>(now) / bytes_a_second));
    return true;
  };
  response.set_content_provider(bytes.size(), kFileType, give);
}

/// Whether a part of `size` bytes is meant; an end that is not given is -1.
bool is_satisfiable(const httplib::Range& range, std::size_t size) {
  const auto [first, last] = range;
  if (first < 0) return last > 0;
  return static_cast<std::uint64_t>(first) < size && (last < 0 || first <= last);
}

}  // namespace

struct PageServer::State {
  std::vector<ServedFile> files;
  std::uint16_t port = 0;
  httplib::Server server;

  std::string path_of(std::size_t file) const {
    return fmt::format("/files/{}/{}", file, files[file].name);
  }
  const ServedFile* find(std::string_view path) const {
    for (std::size_t i = 0; i < files.size(); ++i)
      if (path == path_of(i)) return &files[i];
    return nullptr;
  }
  void answer(const httplib::Request& request, httplib::Response& response, double speed) const;
  bool refuses(const httplib::Request& request, httplib::Response& response) const;
};

void PageServer::State::answer(const httplib::Request& request, httplib::Response& response,
                               double speed) const {
  response.set_header("Cache-Control", "no-store");
  if (const ServedFile* file = find(request.path))
    send(file->bytes, speed, response);
  else
    response.status = 404;
}

/// What must not reach the library's own answers; it takes ranges past the end.
bool PageServer::State::refuses(const httplib::Request& request,
                                httplib::Response& response) const {
  const std::string host = request.get_header_value("Host");
  if (host != fmt::format("{}:{}", kHost, port) && host != fmt::format("localhost:{}", port)) {
    response.status = 403;
    return true;
  }
  const ServedFile* file = find(request.path);
  if (file == nullptr) return false;
  const std::size_t size = file->bytes.size();
  if (std::ranges::all_of(request.ranges,
                          [size](const auto& range) { return is_satisfiable(range, size); }))
    return false;
  response.status = 416;
  response.set_header("Content-Range", fmt::format("bytes */{}", size));
  return true;
}

PageServer::PageServer(const std::string& page, std::vector<ServedFile> files,
                       double bytes_a_second)
    : state_(std::make_unique<State>()) {
  state_->files = std::move(files);
  httplib::Server& server = state_->server;
  server.set_mount_point("/", page);
  server.set_file_extension_and_mimetype_mapping("js", "text/javascript");
  // A port that another program listens on is taken; one that has just been left is not.
  server.set_socket_options([](socket_t socket) {
    const int yes = 1;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  server.Get("/files/.*", [state = state_.get(), bytes_a_second](const httplib::Request& request,
                                                                 httplib::Response& response) {
    state->answer(request, response, bytes_a_second);
  });
  server.set_pre_routing_handler(
      [state = state_.get()](const httplib::Request& request, httplib::Response& response) {
        using Next = httplib::Server::HandlerResponse;
        return state->refuses(request, response) ? Next::Handled : Next::Unhandled;
      });
}

PageServer::~PageServer() = default;

Result<std::string> PageServer::open(std::uint16_t port) {
  httplib::Server& server = state_->server;
  int bound = port;
  if (port == 0)
    bound = server.bind_to_any_port(kHost);
  else if (!server.bind_to_port(kHost, port))
    bound = -1;
  if (bound < 0) return fail(ErrorCode::io, fmt::format("cannot listen on port {}", port));
  state_->port = static_cast<std::uint16_t>(bound);
  // Without its first '/', so that the page finds it wherever it stands itself.
  return fmt::format("http://{}:{}/?url=files/0/{}", kHost, bound, url_of(state_->files[0].name));
}

void PageServer::run() { state_->server.listen_after_bind(); }

}  // namespace pstrips::cli

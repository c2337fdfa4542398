#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/bytes.h"
#include "core/result.h"

namespace pstrips::cli {

/// A file that the viewer shows.
struct ServedFile {
  std::string name;  ///< without folders
  Bytes bytes;
};

/// The viewer and some files, served over HTTP on 127.0.0.1 and to nobody else: requests that name
/// another host are refused, so that no page of the web can reach them through a name of its own.
/// Ranges are answered with 206 and 416.
class PageServer {
 public:
  /// page            folder of the viewer's files
  /// bytes_a_second  what each file is slowed down to; 0: not at all
  PageServer(const std::string& page, std::vector<ServedFile> files, double bytes_a_second);
  ~PageServer();

  /// port  0: any that is free
  ///
  /// returns  the address that shows the first file
  /// errors   io when the port is taken
  Result<std::string> open(std::uint16_t port);
  /// Answers requests until the program ends.
  void run();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pstrips::cli

#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

#include "cli/command.h"
#include "core/progress.h"

namespace pstrips::cli {

/// "[####......]  40 % simplify 0:12, 0:18 left" in at most `columns` characters; narrow terminals
/// lose the bar first. The time left is an extrapolation and is shown once it means something.
std::string progress_line(std::string_view stage, double done, double seconds, std::size_t columns);

/// A progress bar on a terminal, nothing elsewhere. It is drawn again every moment, so that the
/// time runs on while a stage has nothing to say. It is cleared when the object ends, or before
/// that to make room for other text.
class ProgressBar {
 public:
  explicit ProgressBar(const Streams& io) : io_(io) {}
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Empty where nothing is shown.
  Progress callback();
  void show(std::string_view stage, double done);
  void clear();

 private:
  bool is_shown() const { return io_.terminal && !io_.quiet; }
  void draw();  // the mutex is held
  void redraw_until_cleared();

  const Streams& io_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::mutex mutex_;
  std::condition_variable cleared_;
  std::string stage_;
  double done_ = 0;
  bool drawn_ = false;
  std::thread clock_;  // runs while the bar is drawn
};

}  // namespace pstrips::cli

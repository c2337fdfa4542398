#include "cli/progress_bar.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <ostream>

namespace pstrips::cli {
namespace {

constexpr std::size_t kUsualColumns = 80;
constexpr std::size_t kMaxCells = 30;

std::size_t terminal_columns() {
  winsize size{};
  if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return kUsualColumns;
  return size.ws_col;
}

std::string clock_time(double seconds) {
  const auto whole = static_cast<std::uint64_t>(seconds);
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

// A guess is worth showing after a while and a share of the work.
bool can_extrapolate(double done, double seconds) { return seconds >= 2 && done >= 0.05; }

std::string time_words(double done, double seconds) {
  std::string out;
  if (seconds >= 1) out = " " + clock_time(seconds);
  if (can_extrapolate(done, seconds))
    out += fmt::format(", {} left", clock_time(std::ceil(seconds * (1 - done) / done)));
  return out;
}

}  // namespace

std::string progress_line(std::string_view stage, double done, double seconds,
                          std::size_t columns) {
  done = std::clamp(done, 0.0, 1.0);
  const std::string share = fmt::format("{:3.0f} % ", done * 100);
  const std::string time = time_words(done, seconds);
  const std::size_t fixed = share.size() + time.size();
  if (columns <= fixed) return share.substr(0, std::min(share.size(), columns));
  const std::string text(stage.substr(0, columns - fixed));
  const std::size_t left = columns - fixed - text.size();
  if (left < 8) return share + text + time;  // too few cells to show anything
  const std::size_t cells = std::min(left - 3, kMaxCells);
  const auto full = static_cast<std::size_t>(done * static_cast<double>(cells));
  return "[" + std::string(full, '#') + std::string(cells - full, '.') + "] " + share + text + time;
}

Progress ProgressBar::callback() {
  if (!is_shown()) return {};
  return [this](std::string_view stage, double done) {
    show(stage, done);
    return true;
  };
}

void ProgressBar::show(std::string_view stage, double done) {
  if (!is_shown()) return;
  const std::lock_guard lock(mutex_);
  stage_ = stage;
  done_ = done;
  draw();
  if (!clock_.joinable()) clock_ = std::thread([this] { redraw_until_cleared(); });
}

void ProgressBar::draw() {
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start_;
  // The last column stays free: some terminals wrap as soon as it is written.
  const std::string line = progress_line(stage_, done_, passed.count(),
                                         std::max<std::size_t>(terminal_columns(), 2) - 1);
  io_.err << "\r\033[K" << line << std::flush;
  drawn_ = true;
}

void ProgressBar::redraw_until_cleared() {
  std::unique_lock lock(mutex_);
  while (!cleared_.wait_for(lock, std::chrono::milliseconds(250), [this] { return !drawn_; }))
    draw();
}

void ProgressBar::clear() {
  {
    const std::lock_guard lock(mutex_);
    if (drawn_) io_.err << "\r\033[K" << std::flush;
    drawn_ = false;
  }
  cleared_.notify_all();
  if (clock_.joinable()) clock_.join();
}

}  // namespace pstrips::cli

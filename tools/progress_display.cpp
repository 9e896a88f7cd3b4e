#include "progress_display.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace arris::tools {
namespace {

constexpr auto kRedrawInterval = std::chrono::milliseconds(100);

std::string clock_text(double seconds) {
  const auto s = static_cast<std::uint64_t>(std::max(0.0, seconds) + 0.5);
  if (s >= 3600) return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
  return fmt::format("{}:{:02}", s / 60, s % 60);
}

void print_line(const nlohmann::ordered_json& json) {
  std::fputs((json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n").c_str(), stderr);
}

}  // namespace

ProgressDisplay::ProgressDisplay(ProgressMode mode, int verbosity)
    : json_(mode == ProgressMode::kJson),
      bar_(mode == ProgressMode::kAlways ||
           (mode == ProgressMode::kAuto && verbosity >= 0 && isatty(STDERR_FILENO) != 0)),
      verbosity_(verbosity) {}

ProgressDisplay::~ProgressDisplay() {
  finish();
}

void ProgressDisplay::phase(std::string_view name, std::uint64_t total_points) {
  const std::lock_guard lock(mutex_);
  if (!phase_.empty()) draw(true);
  phase_ = name;
  total_ = total_points;
  done_ = 0;
  began_ = drawn_ = Clock::now();
  if (json_) print_line({{"event", "phase"}, {"phase", phase_}, {"points", total_}});
}

void ProgressDisplay::advance(std::uint64_t done_points) {
  const std::lock_guard lock(mutex_);
  done_ += done_points;
  if (Clock::now() - drawn_ >= kRedrawInterval) draw(false);
}

void ProgressDisplay::draw(bool last) {
  drawn_ = Clock::now();
  if (!json_ && !bar_) return;
  const double seconds = std::chrono::duration<double>(drawn_ - began_).count();
  const double rate = seconds > 0.0 ? static_cast<double>(done_) / seconds : 0.0;
  const double share = total_ > 0 ? std::min(1.0, static_cast<double>(done_) / static_cast<double>(total_)) : 0.0;
  const double eta = rate > 0.0 && total_ > done_ ? static_cast<double>(total_ - done_) / rate : 0.0;
  if (json_) {
    print_line({{"event", "progress"},
                {"phase", phase_},
                {"done", done_},
                {"points", total_},
                {"points_per_second", rate},
                {"eta_seconds", eta}});
    return;
  }
  constexpr int kBarWidth = 28;
  const int filled = static_cast<int>(share * kBarWidth);
  std::string bar(static_cast<std::size_t>(filled), '#');
  bar.append(static_cast<std::size_t>(kBarWidth - filled), '.');
  std::fputs(fmt::format("\r{:<10} [{}] {:3.0f} %  {:6.2f} M points/s  {} {}\033[K", phase_, bar, 100.0 * share,
                         rate / 1e6, last ? "took" : "ETA", clock_text(last ? seconds : eta))
                 .c_str(),
             stderr);
  line_open_ = true;
  if (last) {
    std::fputs("\n", stderr);
    line_open_ = false;
  }
}

void ProgressDisplay::wipe() {
  if (line_open_) std::fputs("\r\033[K", stderr);
  line_open_ = false;
}

void ProgressDisplay::finish() {
  const std::lock_guard lock(mutex_);
  if (!phase_.empty()) draw(true);
  phase_.clear();
}

void ProgressDisplay::warning(std::string_view code, std::string_view text) {
  const std::lock_guard lock(mutex_);
  if (json_) {
    print_line({{"event", "warning"}, {"code", code}, {"text", text}});
  } else if (verbosity_ >= 0) {
    wipe();
    std::fputs(fmt::format("arris: warning: {} [{}]\n", text, code).c_str(), stderr);
  }
}

void ProgressDisplay::note(std::string_view text) {
  const std::lock_guard lock(mutex_);
  if (json_) {
    print_line({{"event", "note"}, {"text", text}});
  } else if (verbosity_ >= 0) {
    wipe();
    std::fputs(fmt::format("{}\n", text).c_str(), stderr);
  }
}

}  // namespace arris::tools

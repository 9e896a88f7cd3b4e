#pragma once
/// @file Less work under ThreadSanitizer, where a run takes fifteen times as long and only what threads do together is
/// of interest: what a run computes is the matter of the other suites.

namespace arris::test {

#if defined(__SANITIZE_THREAD__)
constexpr bool kThreadSanitizer = true;
#else
constexpr bool kThreadSanitizer = false;
#endif

}  // namespace arris::test

/// Skips the test under ThreadSanitizer: its threads do nothing that smaller tests of the suite leave out.
#define ARRIS_SKIP_UNDER_THREAD_SANITIZER \
  if (arris::test::kThreadSanitizer) GTEST_SKIP() << "smaller tests use the same threads"

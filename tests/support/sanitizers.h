#pragma once
/// @file Less work under sanitizers, where a run takes five to fifteen times as long. They are to see every piece of
/// code at work; what it computes is the matter of the plain suite.

namespace arris::test {

#if defined(__SANITIZE_THREAD__)
constexpr bool kThreadSanitizer = true;
#else
constexpr bool kThreadSanitizer = false;
#endif
#if defined(__SANITIZE_ADDRESS__)
constexpr bool kAddressSanitizer = true;
#else
constexpr bool kAddressSanitizer = false;
#endif

}  // namespace arris::test

/// Skips a test that uses threads in no way that smaller tests with the label `pipeline` do not.
#define ARRIS_SKIP_UNDER_THREAD_SANITIZER \
  if (arris::test::kThreadSanitizer) GTEST_SKIP() << "smaller tests use the same threads"

/// Skips a test that runs no code that smaller tests do not.
#define ARRIS_SKIP_UNDER_SANITIZERS \
  if (arris::test::kThreadSanitizer || arris::test::kAddressSanitizer) GTEST_SKIP() << "smaller tests run this code"

#include "core/writeback.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstddef>
#include <cstdio>
#include <memory>
#include <vector>

namespace arris {
namespace {

unsigned char byte_at(std::size_t at) {
  return static_cast<unsigned char>(at * 2654435761U >> 24);
}

TEST(Writeback, WhateverStaysInMemory_TheFileIsWhatWasWritten) {
  constexpr std::size_t kPiece = 100'000, kPieces = 80;
  for (const std::uint64_t cached : {std::uint64_t{0}, std::uint64_t{1} << 20, Writeback::kCacheAll}) {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> owner(std::tmpfile(), &std::fclose);
    ASSERT_NE(owner, nullptr);
    const int file = ::fileno(owner.get());
    Writeback writeback(std::uint64_t{256} << 10, cached);
    std::vector<unsigned char> bytes(kPiece);
    for (std::size_t piece = 0; piece < kPieces; ++piece) {
      for (std::size_t i = 0; i < kPiece; ++i) bytes[i] = byte_at(piece * kPiece + i);
      ASSERT_EQ(::write(file, bytes.data(), kPiece), static_cast<ssize_t>(kPiece));
      if (piece == kPieces / 2) ASSERT_EQ(::fsync(file), 0);  // So that there is something to let go.
      writeback.written(file, (piece + 1) * kPiece);
    }
    for (std::size_t piece = 0; piece < kPieces; ++piece) {
      ASSERT_EQ(::pread(file, bytes.data(), kPiece, static_cast<off_t>(piece * kPiece)), static_cast<ssize_t>(kPiece));
      for (std::size_t i = 0; i < kPiece; ++i) ASSERT_EQ(bytes[i], byte_at(piece * kPiece + i)) << piece << ' ' << i;
    }
  }
}

}  // namespace
}  // namespace arris

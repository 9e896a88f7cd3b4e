#pragma once
/// @file The typed exceptions that end a run. Per-point outcomes are values, never exceptions.
///
/// Every message is one line that says what is wrong, in which file and byte or point, and what to do about it.
/// Text taken from input files is passed through printable() (core/text.h) first.

#include <stdexcept>
#include <string>

namespace arris {

/// Base of all arris exceptions. exit_code() is the contract of the command line.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  virtual int exit_code() const noexcept = 0;
};

/// The content of an input is not what its format promises.
class InputError : public Error {
 public:
  using Error::Error;
  int exit_code() const noexcept override { return 1; }
};

/// The operating system refused a read, write, open, rename, ...
class IoError : public Error {
 public:
  using Error::Error;
  int exit_code() const noexcept override { return 1; }
};

/// A parameter or option is outside its valid range, or options contradict each other.
class ConfigError : public Error {
 public:
  using Error::Error;
  int exit_code() const noexcept override { return 2; }
};

/// The memory or disk budget cannot be met; the message gives the least budget that would do.
class BudgetError : public Error {
 public:
  using Error::Error;
  int exit_code() const noexcept override { return 3; }
};

/// The user asked to stop (Ctrl-C).
class Cancelled : public Error {
 public:
  using Error::Error;
  int exit_code() const noexcept override { return 130; }
};

}  // namespace arris

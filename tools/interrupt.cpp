#include "interrupt.h"

#include <unistd.h>

#include <csignal>

namespace arris::tools {
namespace {

CancelToken* token = nullptr;

void on_signal(int) {
  if (token->requested()) _exit(130);
  token->request();
}

}  // namespace

void install_interrupt_handler(CancelToken& cancel) {
  token = &cancel;
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
}

}  // namespace arris::tools

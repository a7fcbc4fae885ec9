// Called once, by run_phase before it reads anything. Loops look at the flag after each step
// through Session::stop_requested, save a checkpoint and return. There is no SA_RESTART: an
// interrupted system call returns EINTR, and publish.cpp goes on writing then.
#include "core/process/signals.hpp"

#include <csignal>

namespace breach::process {

namespace {

// A signal handler may only write this.
volatile std::sig_atomic_t received = 0;

void note(int signal) { received = signal; }

}  // namespace

void watch_signals() {
    struct sigaction action {};
    action.sa_handler = note;
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    action.sa_handler = SIG_IGN;
    sigaction(SIGPIPE, &action, nullptr);
}

bool stop_was_requested() { return received != 0; }

fault::ExitCode code_of_stop() {
    return received == SIGINT ? fault::ExitCode::interrupted : fault::ExitCode::terminated;
}

}  // namespace breach::process

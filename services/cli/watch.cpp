// `breach watch`: follows a run by its events and redraws lines of progress. A server that
// restarts or is busy does not end it: it waits patience_for_the_server before it gives up.
#include "services/cli/watch.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>

#include "services/cli/table.hpp"
#include "services/cli/views.hpp"

namespace breach::cli {

using fault::ExitCode;
using nlohmann::json;
using std::chrono::steady_clock;

namespace {

constexpr std::size_t most_lines = 8;  // tasks shown at once
/// Each look is a request, and short tasks have many events a second.
constexpr auto least_time_between_looks = std::chrono::milliseconds(250);
constexpr auto patience_for_the_server = std::chrono::seconds(60);

/// The events of one run, in order, each once.
class EventTail {
  public:
    EventTail(Server& server, std::string run) : server_(server), run_(std::move(run)) {}

    /// Events since the last call; waits up to a second for one. Progress is not an event, so a
    /// longer wait would delay its display.
    std::vector<json> next() {
        try {
            return take();
        } catch (const Unreachable&) {
            // All event streams may be taken; polling the run still works.
            if (!caught_up_) throw;
            std::this_thread::sleep_for(std::chrono::seconds(1));
            return {};
        }
    }

  private:
    /// Reads the events of all runs from the first one on and keeps its own. Past events come in
    /// parts without waiting; then each call waits for one. With "reset", after a restored backup,
    /// the server gives a number from which to go on, also a lower one.
    std::vector<json> take() {
        std::vector<json> found;
        do {
            json answer = server_.get("/v1/events" + query_of({{"after", std::to_string(next_)},
                                                               {"wait", caught_up_ ? "1" : "0"}}));
            const std::int64_t next = answer.at("next");
            caught_up_ = answer.at("events").empty() || next <= next_;
            next_ = answer.value("reset", false) ? next : std::max(next, next_);
            for (json& event : answer["events"])
                if (event.at("run") == run_) found.push_back(std::move(event));
        } while (!caught_up_ && found.empty());
        return found;
    }

    Server& server_;
    std::string run_;
    std::int64_t next_ = 0;
    bool caught_up_ = false;  // read past events without waiting
};

/// Asked at each drawing, as a window can be resized. A longer line would wrap, and the cursor's
/// way back would be wrong.
std::size_t terminal_width() {
    winsize size{};
    return ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

/// States in which a task has progress to show.
bool is_busy(const json& task) {
    const std::string state = task.at("state");
    return state == "starting" || state == "running" || state == "finalizing" ||
           state == "cancelling" || state == "retry_wait";
}

/// Draws over its previous picture.
/// Escape sequences: A moves the cursor up to the first line, K clears the rest of a line, J what a
/// taller picture left below.
class Picture {
  public:
    explicit Picture(std::ostream& out) : out_(out) {}

    void draw(const json& run) {
        std::vector<std::string> lines{as_progress_line(run)};
        std::size_t hidden = 0;
        for (const json& task : run.at("tasks")) {
            if (!is_busy(task)) continue;
            if (lines.size() > most_lines) {
                ++hidden;
                continue;
            }
            lines.push_back("  " + bar(task.value("progress", 0.0)) + "  " + name_of_task(task) +
                            "  " + cell(task, "message"));
        }
        if (hidden > 0) lines.push_back("  and " + std::to_string(hidden) + " more");
        if (height_ > 0) out_ << "\033[" << height_ << "A";
        const std::size_t width = terminal_width();
        for (const std::string& line : lines) out_ << "\r" << shortened(line, width) << "\033[K\n";
        out_ << "\033[J" << std::flush;
        height_ = lines.size();
    }

  private:
    std::ostream& out_;
    std::size_t height_ = 0;
};

/// Prints one line per task with a new state.
/// For log files and CI. Tasks that wait are no news: a large study makes thousands at once.
class Diary {
  public:
    explicit Diary(std::ostream& out) : out_(out) {}

    void write(const json& run) {
        for (const json& task : run.at("tasks")) {
            std::string& known = states_[task.at("id")];
            if (known == task.at("state").get<std::string>()) continue;
            known = task["state"];
            if (known == "blocked" || known == "ready") continue;
            out_ << bar(run.value("progress", 0.0)) << "  " << name_of_task(task) << "  "
                 << end_of_task(task) << std::endl;
        }
    }

  private:
    std::ostream& out_;
    std::map<std::string, std::string> states_;
};

/// Chooses how news is printed: events for --json, a picture on a terminal, a diary in a file.
/// Each needs the events: they pace the requests for the run.
class Onlooker {
  public:
    Onlooker(Server& server, const std::string& run, const Console& console)
        : server_(server),
          path_(path_of({"runs", run})),
          events_(server, run),
          console_(console),
          picture_(console.out),
          diary_(console.out) {}

    /// Waits for news and prints them; returns the run's state then.
    json look() {
        const auto news = events_.next();
        json run = server_.get(path_);
        if (console_.style == Style::json) {
            for (const json& event : news) console_.out << event.dump() << std::endl;
        } else if (console_.screen == Screen::terminal) {
            picture_.draw(run);
        } else if (console_.screen == Screen::plain) {
            diary_.write(run);
        }
        return run;
    }

  private:
    Server& server_;
    std::string path_;
    EventTail events_;
    const Console& console_;
    Picture picture_;
    Diary diary_;
};

std::string farewell;  // for a signal handler, which may only use what is there

void end_the_watching(int) {
    const auto written = write(STDERR_FILENO, farewell.data(), farewell.size());
    _exit(static_cast<int>(written < 0 ? ExitCode::io : ExitCode::interrupted));
}

/// Ctrl-C ends the command, not the run.
void tell_at_interrupt(const std::string& run) {
    farewell = "\nThe run goes on. To look on: breach watch " + run +
               "; to stop it: breach cancel " + run + "\n";
    std::signal(SIGINT, end_the_watching);
}

}  // namespace

ExitCode watch(Server& server, const std::string& name, Questionable questionable,
               const Console& console) {
    const std::string id = run_named(server, name);
    if (console.screen != Screen::quiet) tell_at_interrupt(id);
    Onlooker onlooker(server, id, console);
    auto answered = steady_clock::now();
    bool ever_answered = false;
    for (;;) {
        const auto began = steady_clock::now();
        try {
            json run = onlooker.look();
            if (!console.out) throw fault::IoError("the output was closed");
            answered = steady_clock::now();
            ever_answered = true;
            if (end_of(run) != RunEnd::not_yet) {
                if (console.style == Style::json) {
                    run.erase("tasks");
                    run.erase("study");
                    console.out << json{{"run", run}}.dump() << std::endl;
                } else {
                    if (console.screen != Screen::terminal)
                        console.out << as_progress_line(run) << "\n";
                    for (const json& task : run.at("tasks"))
                        if (console.screen == Screen::terminal && task.at("state") == "failed")
                            console.out << name_of_task(task) << "  " << end_of_task(task) << "\n";
                }
                return code_of_end(run, questionable, console);
            }
        } catch (const Unreachable&) {
            // A wrong address fails at once: only a server that has answered is worth waiting for.
            if (!ever_answered || steady_clock::now() - answered > patience_for_the_server) throw;
            std::this_thread::sleep_for(std::chrono::seconds(1));
        }
        std::this_thread::sleep_until(began + least_time_between_looks);
    }
}

}  // namespace breach::cli

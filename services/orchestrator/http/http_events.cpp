// Events for pages and clients: a stream, or a long poll for clients that cannot stream. Both
// occupy a thread of the server while they wait, hence the two limits. The sequence number is all
// the state there is, so that a client goes on after a restart where it was.
#include <charconv>
#include <memory>

#include "services/orchestrator/http/answers.hpp"
#include "services/orchestrator/http/http_routes.hpp"

namespace breach::orchestrator {

using nlohmann::json;
using Clock = std::chrono::steady_clock;

namespace {

constexpr int most_streams = 200;  // each needs a thread of the server
constexpr int most_waiters = 32;
constexpr std::size_t largest_batch = 500;
constexpr std::int64_t longest_wait_seconds = 60;
/// Larger integers are not exact in JavaScript.
constexpr std::int64_t largest_seq = std::int64_t{1} << 53;
constexpr auto look_at_stopping = std::chrono::milliseconds(250);
/// Proxies close connections that are silent.
constexpr auto sign_of_life = std::chrono::seconds(15);

std::atomic<int> streams = 0;
std::atomic<int> waiters = 0;

/// One of a limited number of streams; released by the destructor.
/// A thread that waits serves no one else, so waiting clients get a limit of their own, below the
/// number of threads (most_connections in http_server.cpp).
class Seat {
  public:
    Seat(std::atomic<int>& taken, int most, httplib::Response& response) : taken_(taken) {
        // Taken first and given back if that was one too many: no two clients can get the last
        // seat.
        if (taken_.fetch_add(1) < most) return;
        taken_.fetch_sub(1);
        response.set_header("Retry-After", "5");
        throw Problem{503, "/problems/busy", "Too many listeners",
                      "all " + std::to_string(most) + " places are taken; try again"};
    }
    ~Seat() { taken_.fetch_sub(1); }
    Seat(const Seat&) = delete;
    Seat& operator=(const Seat&) = delete;

  private:
    std::atomic<int>& taken_;
};

/// Waits in slices, so that a stopping server ends soon.
/// The store wakes waiters at each commit; the slices are for `stopping`, which wakes no one.
bool wait_for_event(const Store& store, std::int64_t after, Clock::time_point until,
                    const std::atomic<bool>& stopping) {
    while (!stopping && Clock::now() < until) {
        if (store.wait_for_event(after, look_at_stopping)) return true;
    }
    return store.last_event() > after;
}

/// The service never gave this number: its data folder was restored from a backup or made anew
/// since. The client would wait permanently; it must go on after the newest event.
bool is_beyond_newest(const Store& store, std::int64_t after) {
    return after > store.last_event() &&
           store.events_after(after - 1, 1).empty();  // not yet counted, but already readable
}

/// next: what the client sends as `after` in its next request; with `run` it may lie before the
/// newest event, as others' events are left out.
void long_poll(const Service& service, Call& call, const std::atomic<bool>& stopping) {
    const std::int64_t after = call.whole_number("after", 0, 0, largest_seq);
    if (is_beyond_newest(service.store, after))
        return reply(
            call.response,
            {{"events", json::array()}, {"next", service.store.last_event()}, {"reset", true}});
    const std::int64_t wait = call.whole_number("wait", 0, 0, longest_wait_seconds);
    if (wait > 0) {
        const Seat seat(waiters, most_waiters, call.response);
        wait_for_event(service.store, after, Clock::now() + std::chrono::seconds(wait), stopping);
    }
    json list = json::array();
    std::int64_t next = after;
    const auto run = call.parameter("run");
    const auto events = run ? service.store.events_of_run(*run, after, largest_batch)
                            : service.store.events_after(after, largest_batch);
    for (const Event& each : events) {
        list.push_back(as_json(each));
        next = each.seq;
    }
    reply(call.response, {{"events", list}, {"next", next}, {"reset", false}});
}

/// First event of a stream: after Last-Event-ID, else the next.
/// A browser sends Last-Event-ID by itself when it reconnects.
std::int64_t stream_start(const Service& service, const Call& call) {
    const std::string seen = call.request.get_header_value("Last-Event-ID");
    std::int64_t seq = 0;
    const auto parsed = std::from_chars(seen.data(), seen.data() + seen.size(), seq);
    if (!seen.empty() && parsed.ec == std::errc{} && seq >= 0) return seq;
    return call.whole_number("after", service.store.last_event(), 0, largest_seq);
}

struct Stream {
    Seat seat;
    std::int64_t after;
    std::optional<std::string> run;  ///< only its events; empty: of all runs
    // The browser reconnects two seconds after the connection was lost.
    std::string greeting = "retry: 2000\n\n";
    Clock::time_point spoke = Clock::now();
};

bool write(httplib::DataSink& sink, const std::string& text) {
    return sink.write(text.data(), text.size());
}

/// Called again and again by httplib until it returns false. Events of other runs move `after` on
/// without being sent.
bool continue_stream(const Service& service, Stream& stream, httplib::DataSink& sink,
                     const std::atomic<bool>& stopping) {
    if (stopping || !sink.is_writable()) return false;  // release its place
    std::string text;
    if (service.store.wait_for_event(stream.after, look_at_stopping)) {
        for (const Event& each : service.store.events_after(stream.after, largest_batch)) {
            stream.after = each.seq;
            if (stream.run && each.run != *stream.run) continue;
            text += "id: " + std::to_string(each.seq) + "\ndata: " +
                    as_json(each).dump(-1, ' ', false, json::error_handler_t::replace) + "\n\n";
        }
    } else if (Clock::now() - stream.spoke > sign_of_life) {
        text = ": still here\n\n";  // a write shows whether the client is gone
    }
    if (text.empty()) return true;
    stream.spoke = Clock::now();
    return write(sink, text);
}

/// The stream lives on after the handler: httplib keeps the provider, and with it the seat.
void server_sent(const Service& service, Call& call, const std::atomic<bool>& stopping) {
    // An aggregate: its seat cannot be moved.
    auto stream =
        // NOLINTNEXTLINE(modernize-make-shared)
        std::shared_ptr<Stream>(new Stream{Seat(streams, most_streams, call.response),
                                           stream_start(service, call), call.parameter("run")});
    if (is_beyond_newest(service.store, stream->after)) {
        stream->after = service.store.last_event();
        const std::string newest = std::to_string(stream->after);
        stream->greeting += "event: reset\nid: " + newest + "\ndata: {\"next\":" + newest + "}\n\n";
    }
    call.response.set_header("Cache-Control", "no-store");
    call.response.set_header("X-Accel-Buffering", "no");  // nginx would buffer events
    call.response.set_chunked_content_provider(
        "text/event-stream", [&service, &stopping, stream, greeted = false](
                                 std::size_t, httplib::DataSink& sink) mutable {
            if (!greeted) {
                greeted = true;
                return write(sink, stream->greeting);
            }
            try {
                return continue_stream(service, *stream, sink, stopping);
            } catch (const StoreError&) {
                return false;  // the client reconnects
            }
        });
}

}  // namespace

void add_event_routes(Router& router, Service& service, const std::atomic<bool>& stopping) {
    router.get("/v1/events", [&](Call& call) {
        call.allow_parameters({"after", "wait", "run"});
        if (const auto run = call.parameter("run")) wanted_run(service, *run);
        if (call.request.get_header_value("Accept").find("text/event-stream") !=
            std::string::npos) {
            server_sent(service, call, stopping);
        } else {
            long_poll(service, call, stopping);
        }
    });
}

}  // namespace breach::orchestrator

// HTTP requests as bytes, parsed like in the server and answered by all routes of a service with
// one run. The service has no slots, so nothing runs. (tests/unit/orchestrator tests the handlers
// that need a socket.)
#include <httplib.h>
#include <spdlog/spdlog.h>

#include "services/orchestrator/http/http_routes.hpp"
#include "tests/folder.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/unit/orchestrator/small_run.hpp"

using namespace breach;
using namespace breach::orchestrator;

namespace {

/// The request of a client, and the answer.
class ReceivedStream : public httplib::Stream {
  public:
    explicit ReceivedStream(std::string_view sent) : sent_(sent) {}
    bool is_readable() const override { return true; }
    bool is_writable() const override { return true; }
    ssize_t read(char* to, std::size_t most) override {
        const std::size_t count = sent_.copy(to, most);
        sent_.remove_prefix(count);
        return static_cast<ssize_t>(count);
    }
    ssize_t write(const char* from, std::size_t count) override {
        answer_.append(from, count);
        return static_cast<ssize_t>(count);
    }
    void get_remote_ip_and_port(std::string& ip, int& port) const override {
        ip = "127.0.0.1";
        port = 1;
    }
    void get_local_ip_and_port(std::string& ip, int& port) const override {
        get_remote_ip_and_port(ip, port);
    }
    socket_t socket() const override { return -1; }
    const std::string& answer() const { return answer_; }

  private:
    std::string_view sent_;
    std::string answer_;
};

class NoExecutor : public Executor {
  public:
    void submit(const AttemptFolder&, const Order&) override {
        throw fault::IoError("there are no slots");
    }
    Vitals probe(const AttemptFolder&) override { return {Life::gone}; }
    void stop(const AttemptFolder&, StopReason) override {}
    void clear_away(const AttemptFolder&, const std::string&) override {}
    AtStop at_stop() const override { return AtStop::leaves_them; }
};

NewRun known_run() {
    NewRun run = small_run();
    run.id = "run";
    run.study = R"({"transfer_times":[0.5]})";
    return run;
}

DispatchSettings without_slots(const std::filesystem::path& bin) {
    DispatchSettings settings;
    settings.bin = bin;
    settings.slots = 0;
    return settings;
}

/// The service without socket and phases.
class Stand : public httplib::Server {
  public:
    Stand()
        : data_(folder_.path()),
          store_(data_.database()),
          dispatcher_(store_, data_, executor_, board_, without_slots(folder_.path())),
          retention_(store_, data_, {}),
          service_{store_,
                   data_,
                   dispatcher_,
                   retention_,
                   board_,
                   frames_,
                   earlier_costs_,
                   keys_,
                   folder_.path(),
                   {{"lem_tool", 1},
                    {"fem_solver", 1},
                    {"post_seismic", 1},
                    {"transfer_tool", 1},
                    {"mpm_solver", 1}},
                   BREACH_ROOT "/services/web/static",
                   BREACH_ROOT "/workflows"} {
        spdlog::set_level(spdlog::level::off);
        store_.write([](Transaction& transaction) { transaction.add_run(known_run()); });
        add_all_routes(router_, service_, stopping_);
        const Handler handler = [this](const httplib::Request& request,
                                       httplib::Response& response) {
            router_.answer(request, response, Caller{.name = "", .right = Right::admin});
        };
        Get(".*", handler).Post(".*", handler).Put(".*", handler).Delete(".*", handler);
    }

    std::string answer_to(std::string_view sent) {
        ReceivedStream wire(sent);
        bool closed = false;
        process_request(wire, true, closed, nullptr);
        return wire.answer();
    }

  private:
    const test::Folder folder_;
    DataFolder data_;
    Store store_;
    ProgressBoard board_;
    NoExecutor executor_;
    FrameReader frames_;
    EarlierCosts earlier_costs_;
    KeysInProgress keys_;
    Dispatcher dispatcher_;
    Retention retention_;
    Service service_;
    Router router_;
    std::atomic<bool> stopping_ = true;  // ends a stream of events at once
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static Stand stand;
    const std::string answer = stand.answer_to(fuzz::text_of(data, size));
    fuzz::require(answer.empty() || answer.starts_with("HTTP/1.1 "), "an answer is HTTP");
    fuzz::require(!answer.starts_with("HTTP/1.1 500"), "no request is an internal fault");
    return 0;
}

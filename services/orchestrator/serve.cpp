// The order of construction is the order of dependence, and the reverse one that of the end: the
// HTTP server goes first, the store last. Phases are asked for their numerics before the data
// folder is touched, so that a wrong --bin leaves nothing behind.
#include "services/orchestrator/serve.hpp"

#include <pthread.h>
#include <spdlog/spdlog.h>

#include <csignal>
#include <iostream>
#include <memory>
#include <thread>

#include "services/orchestrator/executors/local_executor.hpp"
#include "services/orchestrator/programs/numerics.hpp"

namespace breach::orchestrator {

namespace {

/// One thread waits for SIGINT and SIGTERM; all later threads inherit the mask.
sigset_t blocked_stop_signals() {
    sigset_t set{};
    sigemptyset(&set);
    sigaddset(&set, SIGINT);
    sigaddset(&set, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &set, nullptr);
    return set;
}

std::unique_ptr<Executor> executor_of(const ServeSettings& settings) {
    if (settings.place == Place::slurm)
        return std::make_unique<SlurmExecutor>(settings.slurm, settings.self);
    return std::make_unique<LocalExecutor>(settings.self);
}

/// On stdout for programs that start the service (with --port 0 they need the port), in the log for
/// people.
void announce(const ServeSettings& settings, int port) {
    const std::string url = "http://" + settings.http.host + ":" + std::to_string(port);
    std::cout << nlohmann::json{{"event", "listening"}, {"url", url}, {"port", port}}.dump()
              << std::endl;
    spdlog::info("listening on {}, data in {}, {} slots {}", url, settings.data.string(),
                 settings.dispatch.slots,
                 settings.place == Place::slurm ? "in Slurm" : "on this machine");
}

}  // namespace

int serve(const ServeSettings& settings) {
    const sigset_t stop_signals = blocked_stop_signals();
    // A client that leaves during an answer must not end the service.
    std::signal(SIGPIPE, SIG_IGN);

    const Numerics numerics = numerics_of_phases(settings.dispatch.bin);
    const DataFolder data(settings.data);
    Store store(data.database());
    ProgressBoard board;
    const std::unique_ptr<Executor> executor = executor_of(settings);
    FrameReader frames;
    EarlierCosts earlier_costs;
    KeysInProgress keys;
    DispatchSettings dispatch = settings.dispatch;
    dispatch.numerics = numerics;
    Dispatcher dispatcher(store, data, *executor, board, dispatch);
    Retention retention(store, data, settings.retention);
    Service service{store,
                    data,
                    dispatcher,
                    retention,
                    board,
                    frames,
                    earlier_costs,
                    keys,
                    settings.dispatch.bin,
                    numerics,
                    settings.web,
                    settings.workflows,
                    settings.largest_file_mb << 20,
                    settings.allowed_folders};
    HttpServer server(service, settings.http);

    // The dispatcher has a thread of its own; this one only waits for the signal.
    std::jthread answering([&] { server.serve(); });
    announce(settings, server.port());
    int signal = 0;
    // Not a handler: after sigwait any code may run, as on any other thread.
    sigwait(&stop_signals, &signal);
    spdlog::info(executor->at_stop() == AtStop::ends_them
                     ? "stopping: running phases save their checkpoints"
                     : "stopping: running phases go on");
    server.stop();
    // Before its destructor, which waits for the last, perhaps slow, client.
    dispatcher.stop();
    return 0;
}

}  // namespace breach::orchestrator

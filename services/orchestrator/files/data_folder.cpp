// The one place that knows the layout of the data folder. DataFolder holds the instance lock from
// start to end, as two services on one store would start each task twice.
#include "services/orchestrator/files/data_folder.hpp"

#include <cassert>
#include <chrono>
#include <stdexcept>
#include <thread>

#include "core/fault/fault.hpp"

namespace breach::orchestrator {

namespace {

std::filesystem::path made(const std::filesystem::path& root) {
    std::error_code error;
    std::filesystem::create_directories(root / "runs", error);
    if (!error) std::filesystem::create_directories(root / "files", error);
    if (!error) std::filesystem::create_directories(root / "scratch", error);
    if (!error) std::filesystem::create_directories(root / "arriving", error);
    if (error) throw fault::IoError(root.string() + ": cannot be made: " + error.message());
    return std::filesystem::canonical(root);
}

FileLock owned(const DataPaths& data) {
    // A supervisor holds a killed service's lock until its exec.
    constexpr auto pause = std::chrono::milliseconds(50);
    for (int i = 0; i < 20; ++i) {
        auto lock = FileLock::try_take(data.instance_lock());
        if (lock) return std::move(*lock);
        std::this_thread::sleep_for(pause);
    }
    throw fault::IoError(
        data.root().string() +
        ": another breachline service is running on this data folder; stop it first, or "
        "choose another folder with --data");
}

}  // namespace

DataFolder::DataFolder(const std::filesystem::path& root)
    : DataPaths(made(root)), lock_(owned(*this)) {
    // Leftovers of a killed service.
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(scratch(), error))
        std::filesystem::remove_all(entry.path(), error);
}

std::filesystem::path DataPaths::run(const std::string& run) const {
    if (run.empty()) throw std::logic_error("a run without an id has no folder");
    return root_ / "runs" / run;
}

std::filesystem::path DataPaths::scene(const std::string& run) const {
    return root_ / "runs" / run / "scene.json";
}

std::filesystem::path DataPaths::task(const Task& task) const {
    return root_ / "runs" / task.run / task.label;
}

std::filesystem::path DataPaths::output(const std::string& run, const std::string& label) const {
    return this->run(run) / label / "output";
}

std::filesystem::path DataPaths::input(const Task& task, const Task& parent) const {
    assert(task.parent == parent.id && !task.input.empty());
    return output(parent) / task.input;
}

AttemptFolder DataPaths::attempt(const Task& task, std::int64_t number) const {
    return {this->task(task) / "attempts" / std::to_string(number)};
}

}  // namespace breach::orchestrator

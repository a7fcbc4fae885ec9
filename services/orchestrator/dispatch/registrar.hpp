// Hashes and stores the outputs of tasks whose process has ended, on a thread of its own: hashing a
// large output must not delay the dispatcher.
#pragma once

#include <functional>

#include "services/orchestrator/dispatch/task_queue.hpp"
#include "services/orchestrator/files/data_folder.hpp"
#include "services/orchestrator/store/store.hpp"

namespace breach::orchestrator {

class Registrar {
  public:
    /// `done` is called on the registrar's thread with each task that has left `finalizing`.
    Registrar(Store& store, const DataFolder& data, std::function<void(const std::string&)> done);

    void add(Task task);

  private:
    Handled serve(const Task& task);
    void finalize(const Task& task);
    void keep_remains(const Task& task);
    std::string input_sha256(const Task& task) const;

    Store& store_;
    const DataFolder& data_;
    std::function<void(const std::string&)> done_;
    TaskQueue queue_;  // last: its thread stops before the members it uses are destroyed
};

}  // namespace breach::orchestrator

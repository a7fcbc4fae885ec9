// Layout of the service's data folder.
//
//     <data>/breachline.sqlite         the store
//     <data>/instance.lock             held by the one service that owns the folder
//     <data>/runs/<run>/scene.json     the completed scene
//     <data>/runs/<run>/<label>/output            what the phase writes; all attempts share it
//                                      (checkpoints)
//     <data>/runs/<run>/<label>/reused            names of files that the cache is placing there
//     <data>/runs/<run>/files/         links to the files in <data>/files that its scene names
//     <data>/files/<sha256>.<ending>   uploaded files, by their content
//     <data>/arriving/                 uploads that may be resumed (arriving_file.hpp)
//     <data>/scratch/                  of requests and meshes; emptied at each start
//     <data>/strays/                   what `breachline check --repair` found without a row
//     <data>/backup-under-way          while breachline-backup runs: nothing is removed
//     <data>/runs/<run>/<label>/attempts/fence    held by the one attempt whose phase may run
//     <data>/runs/<run>/<label>/attempts/<n>/     order.json lock heartbeat stdout.jsonl log.txt
//                                      exit.json [stop] [slurm.json]
#pragma once

#include <filesystem>

#include "services/orchestrator/files/file_lock.hpp"
#include "services/orchestrator/records/records.hpp"

namespace breach::orchestrator {

/// The files of one attempt.
struct AttemptFolder {
    std::filesystem::path root;
    std::filesystem::path order() const { return root / "order.json"; }
    std::filesystem::path lock() const { return root / "lock"; }
    std::filesystem::path lines() const { return root / "stdout.jsonl"; }
    std::filesystem::path log() const { return root / "log.txt"; }
    std::filesystem::path exit_record() const { return root / "exit.json"; }
    std::filesystem::path stop() const { return root / "stop"; }
    std::filesystem::path heartbeat() const { return root / "heartbeat"; }
    std::filesystem::path slurm_job() const { return root / "slurm.json"; }
    /// One for all attempts of the task.
    std::filesystem::path fence() const { return root.parent_path() / "fence"; }
};

/// The paths only; creates and locks nothing.
class DataPaths {
  public:
    explicit DataPaths(std::filesystem::path root) : root_(std::move(root)) {}

    std::filesystem::path database() const { return root_ / "breachline.sqlite"; }
    std::filesystem::path runs() const { return root_ / "runs"; }
    /// The folder against which references of a scene are resolved (core/scene/file_paths.hpp).
    const std::filesystem::path& root() const { return root_; }
    std::filesystem::path files() const { return root_ / "files"; }
    /// Everything that a run has on the disk. `run` must not be empty.
    std::filesystem::path run(const std::string& run) const;
    std::filesystem::path scene(const std::string& run) const;
    std::filesystem::path reused(const Task& task) const { return this->task(task) / "reused"; }
    std::filesystem::path output(const Task& task) const { return output(task.run, task.label); }
    std::filesystem::path output(const std::string& run, const std::string& label) const;
    /// The input file of a task, in its parent's output folder; the task must have one.
    std::filesystem::path input(const Task& task, const Task& parent) const;
    AttemptFolder attempt(const Task& task, std::int64_t number) const;
    std::filesystem::path scratch() const { return root_ / "scratch"; }
    /// Files being uploaded (arriving_file.hpp).
    std::filesystem::path arriving() const { return root_ / "arriving"; }
    std::filesystem::path instance_lock() const { return root_ / "instance.lock"; }

  private:
    std::filesystem::path task(const Task& task) const;
    std::filesystem::path root_;
};

class DataFolder : public DataPaths {
  public:
    /// Creates the folder and takes its lock. Throws IoError, naming the folder, when another
    /// service has it.
    explicit DataFolder(const std::filesystem::path& root);

  private:
    FileLock lock_;
};

}  // namespace breach::orchestrator

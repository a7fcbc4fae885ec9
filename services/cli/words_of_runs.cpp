// Commands that submit a study, extend, watch and direct its run, and show what it computed. Called
// by command_line.cpp. Several commands end by watching: watch_run() does it for all, and --strict
// decides in the exit code whether a questionable result is a failure.
#include "services/cli/commands.hpp"
#include "services/cli/program.hpp"
#include "services/cli/watch.hpp"

namespace breach::cli {

using fault::ExitCode;

namespace {

struct Watching {
    std::string run;
    bool asked = false;
    Questionable questionable = Questionable::accepted;
};

/// For submit, sweep and accuracy. For accuracy `watch.run` may name a run that exists: then
/// nothing is submitted.
struct Submission {
    SubmitOptions submit;
    Watching watch;
    bool dry_run = false;
    std::string asked_error;  ///< of accuracy; empty: the study's
};

/// For commands that change one run; each uses its own field.
struct Order {
    std::string run, word, title;
    std::int64_t priority = 0;
};

/// Takes the options of a command that may have been told to watch; done without.
ExitCode watch_run(Server& server, const Watching& watching, const Console& console) {
    return watching.asked ? watch(server, watching.run, watching.questionable, console)
                          : ExitCode::done;
}

ExitCode submit_and_watch(Server& server, const Submission& submission, const Console& console) {
    if (submission.dry_run) return show_plan(server, submission.submit, console);
    Watching watching = submission.watch;
    watching.run = submit(server, submission.submit, console);
    return watch_run(server, watching, console);
}

/// Prints the table of an existing run, or submits and watches a run for it.
ExitCode accuracy(Server& server, const Submission& submission, const Console& console) {
    Watching watching = submission.watch;
    const bool exists = !watching.run.empty();
    if (!exists) watching.run = submit(server, submission.submit, console);
    const ExitCode end = watch_run(server, watching, console);
    if (exists || watching.asked)
        show_accuracy(server, watching.run, submission.asked_error, console);
    return end;
}

void take_strict(CLI::App& word, Questionable& questionable) {
    word.add_flag_callback(
        "--strict", [&questionable] { questionable = Questionable::fails; },
        "exit code 70 when a result is questionable");
}

/// The group requires exactly one of its options: the caller adds the alternative to the file.
CLI::Option_group& take_study_file(CLI::App& word, SubmitOptions& submit) {
    CLI::Option_group* what = word.add_option_group("what");
    what->add_option("STUDY", submit.study,
                     "study file (JSON); a scene named in it is put into it");
    what->require_option(1);
    return *what;
}

/// What a new run may have besides its study. accuracy excludes these where it shows an existing
/// run.
void take_changes(CLI::App& word, Submission& options) {
    word.add_option("--set", options.submit.overrides,
                    "/json/pointer=value, changes the scene; repeatable")
        ->allow_extra_args(false);
    word.add_option("--key", options.submit.idempotency_key,
                    "submitting again with the same key makes no second run");
    word.add_flag("--watch", options.watch.asked, "watch the run until it ends");
    word.add_flag("--send-files", options.submit.send_files,
                  "send motions and meshes even to a server on this machine, which then keeps "
                  "them as they are now");
}

void take_study(Added<Submission> added) {
    auto& [word, options] = added;
    take_study_file(word, options.submit)
        .add_option("--scene", options.submit.scene,
                    "instead: a scene file (JSON), to be run as it is; one with a FEM needs "
                    "--times");
    word.add_option("--times", options.submit.transfer_times,
                    "transfer times instead of the study's, separated by commas [s]")
        ->delimiter(',');
    take_changes(word, options);
    take_strict(word, options.watch.questionable);
}

/// cancel, pause, resume and retry differ in the last part of their path only.
Added<Order> add_order(Program& program, const std::string& name, const std::string& what,
                       const std::string& example,
                       ExitCode (*run)(Server&, const Order&, const Console&)) {
    const auto added = program.add<Order>(name, what, example, run);
    take_run(added.word, added.options.run);
    return added;
}

void add_orders(Program& program) {
    for (const auto& [name, what] :
         {std::pair{"cancel", "stop a run's tasks and skip the rest"},
          {"pause", "start no more tasks of a run; running tasks finish"},
          {"resume", "continue a paused run"},
          {"retry", "try what failed, was skipped or cancelled once more"}})
        add_order(program, name, what, "latest",
                  [](Server& server, const Order& each, const Console& console) {
                      return order(server, each.run, each.word, console);
                  })
            .options.word = name;
    const auto title = add_order(program, "rename", "give a run another title",
                                 "latest \"Weak beach, second try\"",
                                 [](Server& server, const Order& each, const Console& console) {
                                     return rename(server, each.run, each.title, console);
                                 });
    title.word.add_option("TITLE", title.options.title, "one line of at most 200 bytes")
        ->required();
    const auto priority =
        add_order(program, "priority", "which of the waiting tasks go first", "latest 10",
                  [](Server& server, const Order& each, const Console& console) {
                      return set_priority(server, each.run, each.priority, console);
                  });
    priority.word
        .add_option("PRIORITY", priority.options.priority, "-100 to 100; higher goes first")
        ->check(CLI::Range(-100, 100))
        ->required();
}

void add_results(Program& program) {
    const auto& [word, options] = program.add<ResultsOptions>(
        "results", "runout against transfer time", "latest --csv", results);
    take_run(word, options.run);
    word.add_flag("--csv", program.csv, "comma-separated, for other programs");
    word.add_option("--state", options.state, "only rows in this state: questionable");
    word.add_option("--flag", options.flag, "only rows that carry this flag: still_moving");
    word.add_flag("--means", options.means,
                  "only the means over the repeats, if the study has repeats");
    take_strict(word, options.questionable);
}

void add_sweeps(Program& program) {
    const auto sweep =
        program.add<Submission>("sweep", "submit a study as a sweep; prints its id",
                                "study.json --times 0.5,1,1.5 --watch", submit_and_watch);
    sweep.options.submit.route = "/v1/sweeps";
    take_study(sweep);
    const auto& [word, options] = program.add<Extension>(
        "extend", "more transfer times, or more samples; what was computed stays",
        "latest --times 0.75,1.25", extend);
    take_run(word, options.run);
    CLI::Option_group* more = word.add_option_group("more");
    more->add_option("--times", options.times, "transfer times, separated by commas [s]")
        ->delimiter(',');
    more->add_option("--samples", options.samples,
                     "new total of samples of an uncertainty study; the first ones stay")
        ->check(CLI::Range(1, 10000));
    more->require_option(1);
}

void add_accuracy(Program& program) {
    const auto& [word, options] = program.add<Submission>(
        "accuracy", "error against run time: what each setting costs and gives",
        "workflows/accuracy/column.json --watch", accuracy);
    CLI::Option* of = take_study_file(word, options.submit)
                          .add_option("--of", options.watch.run,
                                      "instead: the run of an accuracy study, as far as it is");
    take_changes(word, options);
    for (const char* of_a_new_run : {"--set", "--key", "--send-files"})
        word.get_option(of_a_new_run)->excludes(of);
    word.add_option("--within", options.asked_error, "required error instead of the study's: 0.1")
        ->check(CLI::Range(0.0, 1.0))
        ->needs(of);
    take_strict(word, options.watch.questionable);
}

void add_uncertainty(Program& program) {
    struct Shown {
        UncertaintyOptions show;
        Watching watch;
    };
    const auto& [word, options] = program.add<Shown>(
        "uncertainty",
        "what the samples of an uncertainty study say: percentiles with their intervals, and which "
        "parameter matters",
        "latest --quantity runout_beyond_toe",
        [](Server& server, const Shown& shown, const Console& console) {
            Watching watching = shown.watch;
            watching.run = shown.show.run;
            const ExitCode end = watch_run(server, watching, console);
            show_uncertainty(server, shown.show, console);
            return end;
        });
    take_run(word, options.show.run);
    word.add_flag("--watch", options.watch.asked, "watch the run until it ends, then show");
    word.add_flag("--csv", program.csv, "the samples with their values and results");
    word.add_option("--quantity", options.show.quantity,
                    "only of this number of the results: runout_beyond_toe");
    take_strict(word, options.watch.questionable);
}

}  // namespace

/// A reader meets the commands in this order in `breach --help`.
void add_words_of_runs(Program& program) {
    const auto submit = program.add<Submission>("submit", "submit a study; prints the run's id",
                                                "study.json --watch", submit_and_watch);
    take_study(submit);
    submit.word.add_flag("--dry-run", submit.options.dry_run,
                         "submit nothing: what it would cost and, with \"uncertainty\", how many "
                         "tasks of each phase it would make");
    const auto list = program.add<std::size_t>("list", "the newest runs", "-n 5", list_runs);
    list.options = 20;
    list.word.add_option("-n,--most", list.options, "how many")
        ->check(CLI::Range(1, 500))
        ->capture_default_str();
    const auto shown = program.add<std::string>(
        "show", "a run with its tasks, or a task with its attempts and artifacts", "latest", show);
    shown.word.add_option("RUN|TASK", shown.options, "whose page")->required();
    const auto watched =
        program.add<Watching>("watch", "a run while it runs; ends with it", "latest", watch_run);
    watched.options.asked = true;
    take_run(watched.word, watched.options.run);
    take_strict(watched.word, watched.options.questionable);
    add_orders(program);
    add_results(program);
    add_sweeps(program);
    add_accuracy(program);
    add_uncertainty(program);
}

}  // namespace breach::cli

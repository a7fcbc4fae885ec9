// The words of `breach`: reads arguments, chooses one command, and turns what it throws into an
// exit code. Commands are in files of their own and know nothing of arguments, so that tests call
// them with options. Parsing ends before the first request: a wrong flag costs no connection.
#include "services/cli/command_line.hpp"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <fstream>
#include <functional>
#include <iostream>

#include "core/version/version.hpp"
#include "core/words/nearest.hpp"
#include "services/cli/commands.hpp"
#include "services/cli/completion.hpp"
#include "services/cli/draw.hpp"
#include "services/cli/export_run.hpp"
#include "services/cli/import.hpp"
#include "services/cli/logs.hpp"
#include "services/cli/machinery.hpp"
#include "services/cli/motion.hpp"
#include "services/cli/new_scene.hpp"
#include "services/cli/stored.hpp"
#include "services/cli/table.hpp"
#include "services/cli/verify.hpp"
#include "services/cli/watch.hpp"

namespace breach::cli {

using fault::ExitCode;

namespace {

constexpr const char* default_server = "http://127.0.0.1:8470";

/// The arguments; each command reads its own part.
/// Lives as long as the program; only the fields of the chosen command are filled.
struct Arguments {
    std::string server = default_server;
    std::string token_file;
    std::filesystem::path authority;
    bool json = false;
    bool quiet = false;
    bool csv = false;
    std::string id;  ///< run or task
    std::vector<std::string> ids;
    bool cancel_first = false;
    bool confirmed = false;
    std::vector<std::filesystem::path> files;
    std::string shell;
    SubmitOptions submit;
    bool watch = false;
    bool dry_run = false;
    std::size_t samples = 0;  ///< in all; 0: not given
    bool strict = false;
    ResultsOptions results;
    std::string asked_error;  ///< of accuracy; empty: the study's
    UncertaintyOptions uncertainty;
    std::int64_t priority = 0;
    std::string title;
    std::size_t most_runs = 20;
    LogOptions log;
    bool follow = false;
    TelemetryOptions telemetry;
    HydrographOptions hydrograph;
    std::filesystem::path folder;
    std::filesystem::path document;
    DrawOptions draw;
    MotionOptions motion;
    VerifyOptions verify;
    NewOptions make;
    ImportOptions import;
    TransfersOptions transfers;
};

using Command = std::function<ExitCode(Server&, const Console&)>;

/// From a file, because others on the machine can read a program's arguments.
std::optional<std::string> read_token(const std::string& file) {
    if (file.empty()) return std::nullopt;
    std::ifstream stream(file);
    std::string token;
    if (!(stream >> token)) throw fault::IoError(file + ": holds no token, or cannot be read");
    return token;
}

class CommandLine {
  public:
    CommandLine()
        : app_("Talks to a Breachline server: submits studies and shows their results.", "breach") {
        app_.set_version_flag("--version", std::string("breach ") + version());
        app_.require_subcommand(1);
        app_.fallthrough();  // --json may follow the command
        app_.add_option("--server", a_.server, "the server's address")
            ->envname("BREACH_SERVER")
            ->capture_default_str()
            ->check([](const std::string& url) {
                return address_from(url) ? ""
                                         : url + " is not an address such as " + default_server;
            });
        app_.add_option("--token-file", a_.token_file, "file with the bearer token")
            ->envname("BREACH_TOKEN_FILE");
        app_.add_option("--tls-ca", a_.authority,
                        "PEM file of the authorities to trust instead of the system's")
            ->envname("BREACH_TLS_CA");
        app_.add_flag("--json", a_.json, "the server's answer as JSON");
        app_.add_flag("-q,--quiet", a_.quiet,
                      "only what was asked for, and faults; no progress, no remarks");
        app_.footer(
            "RUN: an id, its beginning, a name (the newest run of it), or `latest`. Exit codes: 0 "
            "done, 2 usage, 65 refused, 70 the run failed "
            "(with\n"
            "--strict: or is questionable), 74 file fault, 75 the server does not answer.");
        add_run_commands();
        add_sweep_commands();
        add_accuracy_command();
        add_uncertainty_command();
        add_task_commands();
        add_file_commands();
        add_templates();
        add_drawing();
        add_motion();
        add_verify();
        add_import();
        add_storage_commands();
        add_machinery();
        add_completion();
    }

    /// Throws CLI::ParseError.
    void parse(int argc, char** argv) {
        std::vector<std::string> words(argv + 1, argv + argc);
        if (const auto command = command_in(words); command != words.end())
            std::rotate(words.begin(), command, command + 1);
        std::ranges::reverse(words);  // CLI11 expects reversed arguments
        app_.parse(words);
    }
    int explain(const CLI::ParseError& error) const {
        if (error.get_exit_code() == 0) return app_.exit(error);  // help was requested
        const CLI::App& named = named_command();
        std::string program = named.get_name();
        for (const CLI::App* each = named.get_parent(); each; each = each->get_parent())
            program = each->get_name() + " " + program;
        const std::vector<std::string> unknown = app_.remaining(true);
        const auto option = std::ranges::find_if(
            unknown, [](const std::string& each) { return each.starts_with("-"); });
        const std::vector<std::string> words = names_below(named);
        if (option != unknown.end()) {
            std::cerr << program << ": unknown option " << harmless(*option)
                      << meant(option->substr(0, option->find('=')), options_of(named)) << "; `"
                      << program << " --help` lists them\n";
        } else if (!unknown.empty() && !words.empty()) {
            std::cerr << program << ": unknown command \"" << harmless(unknown.front()) << "\""
                      << meant(unknown.front(), words) << "; the commands are: " << listed(words)
                      << "\n";
        } else if (error.get_name() == "RequiredError" && !named.get_parent()) {
            std::cerr << "breach: give a command: " << listed(words)
                      << "\nFor example: breach submit study.json --watch\n";
        } else {
            return app_.exit(error);
        }
        return error.get_exit_code();
    }

    ExitCode execute() {
        Server server(*address_from(a_.server), read_token(a_.token_file), a_.authority);
        const Style style = a_.json ? Style::json : a_.csv ? Style::csv : Style::people;
        const Screen screen = a_.quiet                     ? Screen::quiet
                              : isatty(STDOUT_FILENO) == 1 ? Screen::terminal
                                                           : Screen::plain;
        std::ostream nowhere(nullptr);
        return command_(server, {std::cout, a_.quiet ? nowhere : std::cerr, style, screen});
    }

  private:
    /// The command among the words; options may come before it. Skips values of options.
    std::vector<std::string>::iterator command_in(std::vector<std::string>& words) const {
        const auto takes_value = [](const CLI::App& app, const std::string& name) {
            const CLI::Option* option = app.get_option_no_throw(name);
            return option && option->get_items_expected_max() > 0;
        };
        const auto commands = app_.get_subcommands(nullptr);
        for (auto word = words.begin(); word != words.end(); ++word) {
            const bool is_command = std::ranges::any_of(
                commands, [&](const CLI::App* each) { return each->get_name() == *word; });
            if (!is_command) continue;
            const bool is_value = word != words.begin() && (word - 1)->starts_with("-") &&
                                  (takes_value(app_, *(word - 1)) ||
                                   std::ranges::any_of(commands, [&](const CLI::App* each) {
                                       return takes_value(*each, *(word - 1));
                                   }));
            if (!is_value) return word;
        }
        return words.end();
    }

    /// The innermost given command; without one, the program.
    const CLI::App& named_command() const {
        const CLI::App* named = &app_;
        while (!named->get_subcommands().empty()) named = named->get_subcommands().front();
        return *named;
    }

    static std::vector<std::string> names_below(const CLI::App& app) {
        std::vector<std::string> names;
        for (const CLI::App* each : app.get_subcommands(nullptr))
            if (!each->get_name().empty()) names.push_back(each->get_name());
        return names;
    }

    /// Options of the command, of its groups and of the program.
    std::vector<std::string> options_of(const CLI::App& app) const {
        std::vector<std::string> names;
        const auto add_all = [&](const CLI::App& from) {
            for (const CLI::Option* each : from.get_options())
                for (const std::string& name : each->get_lnames()) names.push_back("--" + name);
        };
        add_all(app_);
        add_all(app);
        for (const CLI::App* group : app.get_subcommands(nullptr))
            if (group->get_name().empty()) add_all(*group);
        return names;
    }

    static std::string meant(const std::string& word, const std::vector<std::string>& known) {
        const std::string nearest = words::nearest(word, known);
        return nearest.empty() ? "" : "; did you mean " + nearest + "?";
    }

    static std::string listed(const std::vector<std::string>& words) {
        std::string text;
        for (const std::string& each : words) text += (text.empty() ? "" : ", ") + each;
        return text;
    }

    /// `example`: working arguments, for the command's help.
    CLI::App* add(const std::string& word, const std::string& what, const std::string& example,
                  Command command) {
        CLI::App* sub = app_.add_subcommand(word, what);
        sub->footer("Example:\n  breach " + word + " " + example);
        sub->callback([this, command = std::move(command)] { command_ = command; });
        return sub;
    }

    void take_study(CLI::App* sub) {
        CLI::Option_group* what = sub->add_option_group("what");
        take_study_file(what);
        what->add_option(
            "--scene", a_.submit.scene,
            "instead: a scene file (JSON), to be run as it is; one with a FEM needs --times");
        what->require_option(1);
        sub->add_option("--times", a_.submit.transfer_times,
                        "transfer times instead of the study's, separated by commas [s]")
            ->delimiter(',');
        take_changes(sub);
        take_strict(sub);
    }

    void take_study_file(CLI::App* sub) {
        sub->add_option("STUDY", a_.submit.study,
                        "study file (JSON); a scene named in it is put into it");
    }

    void take_changes(CLI::App* sub) {
        sub->add_option("--set", a_.submit.overrides,
                        "/json/pointer=value, changes the scene; repeatable")
            ->allow_extra_args(false);
        sub->add_option("--key", a_.submit.idempotency_key,
                        "submitting again with the same key makes no second run");
        sub->add_flag("--watch", a_.watch, "watch the run until it ends");
        take_sending(sub);
    }

    void take_sending(CLI::App* sub) {
        sub->add_flag("--send-files", a_.submit.send_files,
                      "send motions and meshes even to a server on this machine, which then keeps "
                      "them as they are now");
    }

    void take_strict(CLI::App* sub) {
        sub->add_flag("--strict", a_.strict, "exit code 70 when a result is questionable");
    }

    Questionable questionable() const {
        return a_.strict ? Questionable::fails : Questionable::accepted;
    }

    ExitCode submit_and_watch(Server& server, const Console& console) {
        const std::string run = submit(server, a_.submit, console);
        return a_.watch ? watch(server, run, questionable(), console) : ExitCode::done;
    }

    /// Prints the table of an existing run, or submits and watches a run for it.
    ExitCode accuracy(Server& server, const Console& console) {
        if (!a_.id.empty()) {
            const ExitCode end =
                a_.watch ? watch(server, a_.id, questionable(), console) : ExitCode::done;
            show_accuracy(server, a_.id, a_.asked_error, console);
            return end;
        }
        const std::string run = submit(server, a_.submit, console);
        if (!a_.watch) return ExitCode::done;
        const ExitCode end = watch(server, run, questionable(), console);
        show_accuracy(server, run, "", console);
        return end;
    }

    void add_accuracy_command() {
        CLI::App* sub = add("accuracy", "error against run time: what each setting costs and gives",
                            "workflows/accuracy/column.json --watch",
                            [this](Server& s, const Console& c) { return accuracy(s, c); });
        CLI::Option_group* what = sub->add_option_group("what");
        take_study_file(what);
        CLI::Option* of = what->add_option(
            "--of", a_.id, "instead: the run of an accuracy study, as far as it is");
        what->require_option(1);
        take_changes(sub);
        for (const char* of_a_new_run : {"--set", "--key", "--send-files"})
            sub->get_option(of_a_new_run)->excludes(of);
        take_asked_error(sub, of);
        take_strict(sub);
    }

    ExitCode uncertainty(Server& server, const Console& console) {
        a_.uncertainty.run = a_.id;
        const ExitCode end =
            a_.watch ? watch(server, a_.id, questionable(), console) : ExitCode::done;
        show_uncertainty(server, a_.uncertainty, console);
        return end;
    }

    void add_uncertainty_command() {
        CLI::App* sub = add("uncertainty",
                            "what the samples of an uncertainty study say: percentiles with their "
                            "intervals, and which parameter matters",
                            "latest --quantity runout_beyond_toe",
                            [this](Server& s, const Console& c) { return uncertainty(s, c); });
        take_run(sub);
        sub->add_flag("--watch", a_.watch, "watch the run until it ends, then show");
        sub->add_flag("--csv", a_.csv, "the samples with their values and results");
        sub->add_option("--quantity", a_.uncertainty.quantity,
                        "only of this number of the results: runout_beyond_toe");
        take_strict(sub);
    }

    void take_asked_error(CLI::App* sub, CLI::Option* of) {
        sub->add_option("--within", a_.asked_error, "required error instead of the study's: 0.1")
            ->check(CLI::Range(0.0, 1.0))
            ->needs(of);
    }

    void add_sweep_commands() {
        take_study(add("sweep", "submit a study as a sweep; prints its id",
                       "study.json --times 0.5,1,1.5 --watch", [this](Server& s, const Console& c) {
                           a_.submit.route = "/v1/sweeps";
                           return submit_and_watch(s, c);
                       }));
        CLI::App* extend_ =
            add("extend", "more transfer times, or more samples; what was computed stays",
                "latest --times 0.75,1.25", [this](Server& s, const Console& c) {
                    return a_.samples > 0 ? extend_samples(s, a_.id, a_.samples, c)
                                          : extend(s, a_.id, a_.submit.transfer_times, c);
                });
        take_run(extend_);
        CLI::Option_group* more = extend_->add_option_group("more");
        more->add_option("--times", a_.submit.transfer_times,
                         "transfer times, separated by commas [s]")
            ->delimiter(',');
        more->add_option("--samples", a_.samples,
                         "new total of samples of an uncertainty study; the first ones stay")
            ->check(CLI::Range(1, 10000));
        more->require_option(1);
    }

    void add_run_commands() {
        CLI::App* submit_ =
            add("submit", "submit a study; prints the run's id", "study.json --watch",
                [this](Server& s, const Console& c) {
                    return a_.dry_run ? show_plan(s, a_.submit, c) : submit_and_watch(s, c);
                });
        take_study(submit_);
        submit_->add_flag("--dry-run", a_.dry_run,
                          "submit nothing: what it would cost and, with \"uncertainty\", how many "
                          "tasks of each phase it would make");

        CLI::App* list_ =
            add("list", "the newest runs", "-n 5",
                [this](Server& s, const Console& c) { return list_runs(s, a_.most_runs, c); });
        list_->add_option("-n,--most", a_.most_runs, "how many")
            ->check(CLI::Range(1, 500))
            ->capture_default_str();

        CLI::App* show_ =
            add("show", "a run with its tasks, or a task with its attempts and artifacts", "latest",
                [this](Server& s, const Console& c) { return show(s, a_.id, c); });
        show_->add_option("RUN|TASK", a_.id, "whose page")->required();

        CLI::App* watch_ =
            add("watch", "a run while it runs; ends with it", "latest",
                [this](Server& s, const Console& c) { return watch(s, a_.id, questionable(), c); });
        take_run(watch_);
        take_strict(watch_);
        add_orders();
        CLI::App* results_ = add("results", "runout against transfer time", "latest --csv",
                                 [this](Server& s, const Console& c) {
                                     a_.results.run = a_.id;
                                     a_.results.questionable = questionable();
                                     return results(s, a_.results, c);
                                 });
        take_run(results_);
        results_->add_flag("--csv", a_.csv, "comma-separated, for other programs");
        results_->add_option("--state", a_.results.state, "only rows in this state: questionable");
        results_->add_option("--flag", a_.results.flag,
                             "only rows that carry this flag: still_moving");
        results_->add_flag("--means", a_.results.means,
                           "only the means over the repeats, if the study has repeats");
        take_strict(results_);
    }

    void add_order(const std::string& word, const std::string& what) {
        take_run(add(word, what, "latest", [this, word](Server& s, const Console& c) {
            return order(s, a_.id, word, c);
        }));
    }

    void add_orders() {
        add_order("cancel", "stop a run's tasks and skip the rest");
        add_order("pause", "start no more tasks of a run; running tasks finish");
        add_order("resume", "continue a paused run");
        add_order("retry", "try what failed, was skipped or cancelled once more");
        CLI::App* rename_ =
            add("rename", "give a run another title", "latest \"Weak beach, second try\"",
                [this](Server& s, const Console& c) { return rename(s, a_.id, a_.title, c); });
        take_run(rename_);
        rename_->add_option("TITLE", a_.title, "one line of at most 200 bytes")->required();
        CLI::App* priority_ = add(
            "priority", "which of the waiting tasks go first", "latest 10",
            [this](Server& s, const Console& c) { return set_priority(s, a_.id, a_.priority, c); });
        take_run(priority_);
        priority_->add_option("PRIORITY", a_.priority, "-100 to 100; higher goes first")
            ->check(CLI::Range(-100, 100))
            ->required();
    }

    void add_task_commands() {
        CLI::App* logs_ =
            add("logs", "a task's log", "TASK -f", [this](Server& s, const Console& c) {
                a_.log.follow = a_.follow ? Follow::until_the_end : Follow::no;
                return show_log(s, a_.log, c);
            });
        logs_->add_option("TASK", a_.log.task, "whose log; `show RUN` lists the tasks")->required();
        logs_->add_option("--attempt", a_.log.attempt, "which attempt (default: the newest)");
        logs_->add_option("-n,--lines", a_.log.lines, "only the last lines, this many");
        logs_->add_flag("-f,--follow", a_.follow, "go on until the task ends");

        TelemetryOptions& options = a_.telemetry;
        CLI::App* telemetry_ =
            add("telemetry", "what a phase measured while it ran",
                "latest mpm_solver --transfer-time 0.5 --csv",
                [this](Server& s, const Console& c) { return telemetry(s, a_.telemetry, c); });
        telemetry_->add_option("RUN", options.run, "which run")->required();
        telemetry_->add_option("PHASE", options.phase, "fem_solver or mpm_solver")->required();
        telemetry_->add_option("--transfer-time", options.transfer_time,
                               "which of the sweep's runouts [s]");
        telemetry_->add_option("--variant", options.variant, "which of the study's variants");
        telemetry_->add_option("--fields", options.fields, "only these, separated by commas");
        telemetry_->add_option("--from", options.from, "first line, counted from 0")
            ->check(CLI::NonNegativeNumber);
        telemetry_->add_option("--stride", options.stride, "every n-th line")
            ->check(CLI::PositiveNumber);
        telemetry_->add_flag("--csv", a_.csv, "comma-separated, for other programs");
        add_hydrograph();
    }

    void add_hydrograph() {
        HydrographOptions& options = a_.hydrograph;
        CLI::App* sub =
            add("hydrograph", "what passed a section of a runout, for HEC-RAS, FLO-2D or as CSV",
                "latest --section toe --for hec-ras --breach-width 72 --output toe.csv",
                [this](Server& s, const Console& c) { return hydrograph(s, a_.hydrograph, c); });
        sub->add_option("RUN", options.run, "which run")->required();
        sub->add_option("--section", options.section, "its name in the scene's /mpm/sections")
            ->required();
        sub->add_option("--for", options.target, "csv, hec-ras or flo-2d")
            ->check(CLI::IsMember({"csv", "hec-ras", "flo-2d"}))
            ->capture_default_str();
        sub->add_option("--breach-width", options.breach_width,
                        "72, or 60,72,90 for low, best, high [m] (default: the scene's)");
        sub->add_option("--interval", options.interval,
                        "between two flows, for hec-ras and flo-2d [s] (1)");
        sub->add_option("--transfer-time", options.transfer_time,
                        "which of the sweep's runouts [s]");
        sub->add_option("--variant", options.variant, "which of the study's variants");
        sub->add_option("--cell", options.cell, "FLO-2D's grid element that takes the inflow (1)");
        sub->add_option("--concentration", options.concentration,
                        "FLO-2D: solids by volume, 0 to 1; adds the column for mudflow");
        sub->add_option("--output", options.file, "a file instead of the screen");
    }

    void add_file_commands() {
        CLI::App* export_ =
            add("export", "a run as a folder: results, study, logs, verified artifacts",
                "latest slope-run/",
                [this](Server& s, const Console& c) { return export_run(s, a_.id, a_.folder, c); });
        take_run(export_);
        export_
            ->add_option("DIR", a_.folder,
                         "a new or empty folder, or one with an earlier export of the run")
            ->required();
        CLI::App* plan_ = add(
            "plan", "what a scene or a study needs of each phase, what it leaves out, and why",
            "scene.json", [this](Server& s, const Console& c) { return plan(s, a_.document, c); });
        plan_->add_option("SCENE|STUDY", a_.document, "scene or study file (JSON)")->required();
    }

    void add_templates() {
        take_templates(*add("new", "a scene and its study from a template: --list has them",
                            "upstream_dam --height 30 --output my_dam",
                            [this](Server&, const Console& c) { return make_new(a_.make, c); }),
                       a_.make);
    }

    void add_drawing() {
        CLI::App* draw_ = add("draw", "the section of a scene or a study, and what it will cost",
                              "scene.json --output section.svg",
                              [this](Server& s, const Console& c) { return draw(s, a_.draw, c); });
        draw_->add_option("SCENE|STUDY", a_.draw.document, "scene or study file (JSON)")
            ->required();
        draw_->add_option("--output", a_.draw.picture,
                          "the picture (SVG); without it only the cost");
        draw_
            ->add_option("--set", a_.draw.overrides,
                         "/json/pointer=value, changes the scene; repeatable")
            ->allow_extra_args(false);
        draw_->add_flag("--mesh", a_.draw.mesh, "draw the FEM's mesh, too; made once and kept");
    }

    void add_verify() {
        VerifyOptions& options = a_.verify;
        CLI::App* sub = add(
            "verify", "compare the programs with closed forms, published tables and other programs",
            "--quick --output verification",
            [this](Server&, const Console& c) { return verify(a_.verify, c); });
        sub->add_flag("--quick", options.quick,
                      "without the slow cases; else all of them (--full)");
        sub->add_flag("!--full", options.quick, "all cases; the default");
        sub->add_option("--output", options.output, "folder of the pages")->capture_default_str();
        sub->add_option("--catalogue", options.catalogue, "folder of other cases")
            ->check(CLI::ExistingDirectory);
    }

    void add_motion() {
        MotionOptions& options = a_.motion;
        CLI::App* sub = add(
            "motion",
            "measures of a record (PGA, PGV, Arias, MASI, spectrum), or the findings of a study of "
            "several",
            "record.AT2 --scale-to-pga-g 0.3",
            [this](Server& server, const Console& c) { return show_motion(server, a_.motion, c); });
        CLI::Option_group* what = sub->add_option_group("what");
        CLI::Option* file = what->add_option(
            "FILE", options.file, "acceleration: PEER, CSV or two columns; or a folder of them");
        what->add_option("--of", options.run, "instead: the run of a study of several motions");
        what->require_option(1);
        sub->add_option("--scale-to-pga-g", options.scale_to_pga_g, "peak acceleration [g]")
            ->check(CLI::PositiveNumber)
            ->needs(file);
        sub->add_flag("--corrected", options.corrected, "correct the baseline first")->needs(file);
        CLI::Option* scene =
            sub->add_option("--scene", options.scene,
                            "of a folder: print a study that shakes this scene by each record");
        scene->needs(file)->check(CLI::ExistingFile);
        sub->add_option("--pga-g", options.pga_g, "with --scene: scaled to each of these, 0.1,0.3")
            ->delimiter(',')
            ->check(CLI::PositiveNumber)
            ->needs(scene);
    }

    void add_import() {
        ImportOptions& options = a_.import;
        CLI::App* import_ =
            add("import", "a section drawn as DXF or CSV becomes a scene",
                "dam.dxf --materials materials.json --map CORE=clay --unit m --output scene.json",
                [this](Server&, const Console& c) { return import_drawing(a_.import, c); });
        import_->add_option("DRAWING", options.drawing, "DXF (text form), or CSV with region,x,y")
            ->required();
        import_->add_option("--materials", options.materials, "JSON with a scene's materials")
            ->required();
        import_->add_option("--output", options.output, "the scene (JSON)")->required();
        import_->add_option("--draw", options.picture, "the section (SVG), with its faults in red");
        const auto repeatable = [&](const char* option, std::vector<std::string>& to,
                                    const char* what) {
            import_->add_option(option, to, what)->allow_extra_args(false);
        };
        repeatable("--map", options.map,
                   "LAYER=material, or LAYER=phreatic, terrain, ground, none; repeatable");
        repeatable(
            "--layers", options.layers,
            "REGION=5,10,15 cuts it at these depths below the phreatic line [m]; repeatable");
        import_->add_option("--phreatic", options.phreatic, "phreatic line (CSV with x,y)");
        import_->add_option("--terrain", options.terrain, "terrain of the runout (CSV with x,y)");
        import_->add_option("--ground", options.ground, "ground to compare with (CSV with x,y)");
        import_
            ->add_option("--tolerance", options.tolerance,
                         "gaps and overlaps up to this are healed [m]")
            ->capture_default_str();
        import_->add_option("--unit", options.unit,
                            "of the drawing: m, mm, cm, ft, ...; DXF may say it itself");
        import_->add_option("--flatten", options.flatten,
                            "arcs become chords that are off by at most this [m]");
        import_->add_option("--name", options.name, "of the scene; else the drawing's");
        import_->add_flag("--with-fem", options.with_fem, help_of_dam("with_fem"));
        import_->add_option("--pga", options.pga, help_of_dam("pga"));
        import_->add_option("--shaking", options.shaking, help_of_dam("shaking"));
        import_->add_flag("--force", options.force,
                          "with --with-fem: write over study.json and motion.csv beside the scene");
        import_->add_flag("--yes", options.confirmed,
                          "sizes that look like a slip of the unit are meant");
    }

    void add_storage_commands() {
        CLI::App* rm = add("rm", "remove runs, or files that were sent, from the server's disk",
                           "latest --cancel", [this](Server& s, const Console& c) {
                               const IfItRuns options =
                                   a_.cancel_first ? IfItRuns::cancel_first : IfItRuns::refuse;
                               return remove_all(s, a_.ids, options,
                                                 a_.confirmed ? Confirm::given : Confirm::ask, c);
                           });
        rm->add_option("RUN|FILE", a_.ids, "runs, or files as file:sha256/...")->required();
        rm->add_flag("--cancel", a_.cancel_first,
                     "cancel runs that have not ended, then remove them");
        rm->add_flag("-y,--yes", a_.confirmed, "do not ask, for scripts");
        add("du", "disk space that the server uses, and what removing each run would free",
            "--json", [](Server& s, const Console& c) { return disk_use(s, c); });
        CLI::App* files =
            add("files", "the motions and meshes that were sent; with FILE: send it", "motion.csv",
                [this](Server& s, const Console& c) {
                    return a_.files.empty() ? list_files(s, c) : send_files(s, a_.files, c);
                });
        files->add_option("FILE", a_.files, "send these, print how a scene names them");
        take_run(add("open", "print the dashboard's address of a run", "latest",
                     [this](Server& s, const Console& c) { return open_page(s, a_.id, c); }));
    }

    void add_machinery() {
        add("workers", "what runs where, and the queue", "--json",
            [](Server& s, const Console& c) { return workers(s, c); });
        CLI::App* transfers_ =
            add("transfers", "why each transfer was made, how long it waited, what came of it",
                "latest --why criterion",
                [this](Server& s, const Console& c) { return transfers(s, a_.transfers, c); });
        transfers_->add_option("RUN", a_.transfers.run, "only of this run");
        transfers_
            ->add_option("--why", a_.transfers.why,
                         "only at_time, manual, criterion, window, bisect")
            ->check(CLI::IsMember({"at_time", "manual", "criterion", "window", "bisect"}));
        transfers_->add_option("-n,--most", a_.transfers.most, "how many")
            ->check(CLI::Range(1, 500))
            ->capture_default_str();
    }

    void add_completion() {
        CLI::App* sub = add("completion", "print a script that completes words in a shell",
                            "bash > ~/.local/share/bash-completion/completions/breach\n"
                            "  breach completion zsh > ~/.zfunc/_breach\n"
                            "  breach completion fish > ~/.config/fish/completions/breach.fish",
                            [this](Server&, const Console& c) {
                                c.out << completion(app_, a_.shell);
                                return ExitCode::done;
                            });
        sub->add_option("SHELL", a_.shell, "bash, zsh or fish")
            ->required()
            ->check(CLI::IsMember({"bash", "zsh", "fish"}));
    }

    void take_run(CLI::App* sub) { sub->add_option("RUN", a_.id, "which run")->required(); }

    CLI::App app_;
    Arguments a_;
    Command command_;
};

void tell(const std::string& summary, const std::vector<fault::Fault>& faults) {
    std::cerr << "breach: " << harmless(summary) << "\n";
    for (const fault::Fault& each : faults) {
        std::cerr << "  " << (each.pointer.empty() ? "/" : harmless(each.pointer)) << ": "
                  << harmless(each.cause) << "\n";
        if (!each.remedy.empty()) std::cerr << "      remedy: " << harmless(each.remedy) << "\n";
    }
}

ExitCode guarded(CommandLine& line) {
    try {
        return line.execute();
    } catch (const Refused& error) {
        tell(error.what(), error.faults());
        return ExitCode::bad_input;
    } catch (const fault::BadInput& error) {
        std::cerr << "breach: " << error.what() << "\n";  // what() lists the faults
        return ExitCode::bad_input;
    } catch (const Unreachable& error) {
        tell(error.what(), {});
        return ExitCode::try_again;
    } catch (const fault::IoError& error) {
        tell(error.what(), {});
        return ExitCode::io;
    } catch (const nlohmann::json::exception& error) {
        tell(std::string("the server's answer is not what this version expects: ") + error.what(),
             {});
        return ExitCode::io;
    } catch (const std::exception& error) {
        tell(error.what(), {});
        return ExitCode::io;
    }
}

}  // namespace

int run(int argc, char** argv) {
    std::signal(SIGPIPE, SIG_IGN);  // a lost server gets its own message
    CommandLine line;
    try {
        line.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return line.explain(error) == 0 ? 0 : static_cast<int>(ExitCode::usage);
    }
    const ExitCode code = guarded(line);
    std::cout.flush();
    if (!std::cout && code == ExitCode::done) return static_cast<int>(ExitCode::io);
    return static_cast<int>(code);
}

}  // namespace breach::cli

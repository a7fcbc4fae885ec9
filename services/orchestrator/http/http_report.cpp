// The report of a run. The program `report` makes it from the folder that `breach export` would
// write; the phases' files are linked, not copied. Run on the request's thread, for at most five
// minutes.
#include <memory>
#include <mutex>

#include "core/command/command.hpp"
#include "core/exchange/publish.hpp"
#include "core/exchange/temporary_folder.hpp"
#include "services/orchestrator/http/http_routes.hpp"

namespace breach::orchestrator {

using nlohmann::json;
namespace fs = std::filesystem;

namespace {

constexpr auto longest = std::chrono::minutes(5);

/// Asks this very API for each document, with the caller's own rights: the report then says what
/// the API says, and needs no reading of its own.
class Folder {
  public:
    Folder(const Router& router, const Service& service, const Call& call, fs::path path)
        : router_(router), service_(service), call_(call), path_(std::move(path)) {}

    void fill() {
        const std::string& id = call_.parts[0];
        // Tasks come in pages below: a run may have thousands.
        const json run = answer("", {{"tasks", "0"}});
        keep("run.json", run);
        keep("study.json", run.at("study"));
        keep("results.json", answer("/results"));
        if (run.at("study").contains("uncertainty"))
            for (const char* each : {"uncertainty", "envelopes"})
                keep(std::string(each) + ".json", answer(std::string("/") + each));
        keep_motions();
        // Motions that the scene names by reference are looked for there.
        if (const fs::path files = service_.data.run(id) / "files"; fs::exists(files))
            fs::create_directory_symlink(fs::absolute(files), path_ / "files");
        json page{{"next", ""}};
        while (page.at("next").is_string()) {
            page = answer("/tasks", {{"limit", "500"}, {"cursor", page["next"]}});
            for (const json& each : page.at("tasks")) add_task(id, each);
        }
    }

  private:
    /// The answer of this API; problems pass through.
    json answer(const std::string& part,
                const std::vector<std::pair<std::string, std::string>>& parameters = {}) const {
        httplib::Request request;
        request.method = "GET";
        request.path = "/v1/runs/" + call_.parts[0] + part;
        for (const auto& [name, value] : parameters)
            // The first page has no cursor.
            if (!value.empty()) request.params.emplace(name, value);
        httplib::Response response;
        router_.answer(request, response, call_.caller);
        json body = json::parse(response.body);
        if (response.status >= 300)
            throw Problem{response.status, body.at("type"), body.at("title"), body.at("detail")};
        return body;
    }

    /// For a study of several motions only.
    void keep_motions() const {
        try {
            keep("motions.json", answer("/motions"));
        } catch (const Problem& none) {
            if (none.status != 404) throw;
        }
    }

    void keep(const std::string& name, const json& content) const {
        exchange::publish_text(path_ / name,
                               content.dump(-1, ' ', false, json::error_handler_t::replace));
    }

    void add_task(const std::string& run, const json& task) const {
        const std::string label = task.at("label");
        const fs::path here = path_ / "tasks" / label;
        fs::create_directories(here);
        keep("tasks/" + label + "/task.json", task);
        for (const json& each : task.at("artifacts")) {
            const fs::path name = each.at("name").get<std::string>();
            fs::create_directories((here / name).parent_path());
            fs::create_symlink(fs::absolute(service_.data.output(run, label) / name), here / name);
        }
    }

    const Router& router_;
    const Service& service_;
    const Call& call_;
    fs::path path_;
};

/// The program beside this one.
fs::path report_program() { return fs::canonical("/proc/self/exe").parent_path() / "report"; }

void send_report(const Router& router, const Service& service, Call& call) {
    call.allow_parameters({});
    const Run run = wanted_run(service, call.parts[0]);
    const exchange::TemporaryFolder scratch("report-", service.data.scratch());
    Folder(router, service, call, scratch.path()).fill();
    const fs::path page = scratch.path() / "report.html";
    const command::Result made =
        command::run({report_program(), scratch.path(), "--output", page, "--alone"}, "", longest);
    // The program's own words say what is missing.
    if (made.exit_code != 0)
        throw Problem{409, "/problems/nothing-to-report", "Nothing to report",
                      made.err.empty() ? "the program report was stopped" : made.err};
    call.response.set_header("Content-Disposition",
                             "attachment; filename=\"" + run.id + "-report.html\"");
    call.response.set_content(whole_text(page), "text/html; charset=utf-8");
}

}  // namespace

void add_report_routes(Router& router, Service& service) {
    const auto one_at_a_time = std::make_shared<std::mutex>();  // each needs a core and much memory
    router.get("/v1/runs/{id}/report", [&router, &service, one_at_a_time](Call& call) {
        const std::lock_guard lock(*one_at_a_time);
        send_report(router, service, call);
    });
}

}  // namespace breach::orchestrator

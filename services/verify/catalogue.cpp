#include "services/verify/catalogue.hpp"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "core/fault/fault.hpp"

namespace breach::verify {

using nlohmann::json;
namespace fs = std::filesystem;

namespace {

/// One entry of a file, and its faults.
class Entry {
  public:
    Entry(const json& of, std::string pointer, std::vector<fault::Fault>& faults)
        : of_(of), pointer_(std::move(pointer)), faults_(faults) {}

    void blame(const std::string& key, const std::string& cause, const std::string& remedy) {
        faults_.push_back({pointer_ + "/" + key, cause, remedy});
    }
    std::string text(const std::string& key, const std::string& remedy) {
        if (of_.contains(key) && of_.at(key).is_string() && of_.at(key) != "") return of_.at(key);
        blame(key, "is missing", remedy);
        return "";
    }
    double number(const std::string& key, const std::string& remedy) {
        if (of_.contains(key) && of_.at(key).is_number()) return of_.at(key);
        blame(key, "is missing", remedy);
        return 0.0;
    }
    /// A list that must not be empty.
    std::vector<std::pair<json, std::string>> list(const std::string& key) {
        std::vector<std::pair<json, std::string>> items;
        const json given = of_.value(key, json::array());
        for (std::size_t k = 0; k < given.size(); ++k)
            items.emplace_back(given[k], pointer_ + "/" + key + "/" + std::to_string(k));
        if (items.empty()) blame(key, "is empty", "give at least one");
        return items;
    }
    void only(const std::set<std::string>& known) {
        for (const auto& [key, value] : of_.items())
            if (!known.contains(key)) blame(key, "is not known", "take it out");
    }
    const json& of() const { return of_; }
    std::string at(const std::string& key) const { return pointer_ + "/" + key; }

  private:
    const json& of_;
    std::string pointer_;
    std::vector<fault::Fault>& faults_;
};

Quantity quantity_from(Entry entry) {
    entry.only({"what", "file", "at", "where", "right", "relative", "absolute", "because", "scale",
                "limit"});
    const json& of = entry.of();
    Quantity made{
        .what = entry.text("what", "name it"),
        .place = {of.value("file", "result.json"), entry.text("at", "give its place"), ""},
        .right = entry.number("right", "give the right value"),
        .allowed = 0.0,
        .relative = of.contains("relative"),
        .because = entry.text("because", "say why so much is allowed"),
        .scale = of.value("scale", 1.0)};
    if (of.contains("limit")) made.limit = entry.number("limit", "give what it converges to");
    if (of.contains("where") && of.at("where").size() == 1) {
        made.place.key = of.at("where").begin().key();
        made.place.value = of.at("where").begin().value();
    }
    made.allowed =
        entry.number(made.relative ? "relative" : "absolute", "say how far it may be off");
    if (!(made.allowed > 0.0))
        entry.blame("relative", "is not positive", "no two programs agree to the last digit");
    return made;
}

Level level_from(Entry entry) {
    entry.only({"size", "set"});
    return {entry.number("size", "give the length or the time that is refined"),
            entry.of().value("set", std::vector<std::string>())};
}

using Commands = std::vector<std::vector<std::string>>;

/// The case's commands, else a run of its program, else the file's; each with its `set`.
Commands commands_of(const json& of, const json& file) {
    Commands commands = of.value("commands", Commands());
    if (commands.empty() && !of.contains("program")) commands = file.value("commands", Commands());
    if (commands.empty())
        commands = {{of.value("program", file.value("program", "")), "{input}", "--output",
                     "{output}", "--progress", "none"}};
    for (const std::string& each : of.value("set", std::vector<std::string>()))
        for (std::vector<std::string>& command : commands)
            command.insert(command.end(), {"--set", each});
    return commands;
}

/// The exit code becomes the case's quantity.
Refusal refusal_from(Entry entry, std::vector<Quantity>& quantities) {
    entry.only({"exit", "says"});
    Refusal made{static_cast<int>(entry.number("exit", "give the exit code")), {}};
    std::string what = "exit code; says";
    for (const auto& [item, pointer] : entry.list("says")) {
        made.says.push_back(item);
        what += " \"" + made.says.back() + "\"";
    }
    quantities.push_back({.what = what,
                          .place = {},
                          .right = static_cast<double>(made.exit_code),
                          .allowed = 0.5,
                          .relative = false,
                          .because = "the right answer is a refusal"});
    return made;
}

Case case_from(Entry entry, const json& file, const fs::path& folder,
               std::vector<fault::Fault>& faults) {
    entry.only({"id", "question", "source", "kind", "scene", "set", "program", "commands", "levels",
                "slow", "quantities", "refused"});
    const json& of = entry.of();
    Case made{.id = entry.text("id", "name it"),
              .question = entry.text("question", "say what is asked"),
              .source = entry.text("source", "say where the right value is from"),
              .kind = entry.text("kind", "closed form, published or program"),
              .scene = {},
              .commands = commands_of(of, file),
              .levels = {},
              .slow = of.value("slow", false),
              .quantities = {}};
    if (of.contains("scene")) made.scene = folder / of.at("scene").get<std::string>();
    if (!made.scene.empty() && !fs::exists(made.scene))
        entry.blame("scene", "is no file: " + made.scene.string(), "put it beside the catalogue");
    if (of.contains("refused")) {
        made.refusal =
            refusal_from({of.at("refused"), entry.at("refused"), faults}, made.quantities);
        if (of.contains("quantities") || of.contains("levels"))
            entry.blame("refused", "is given together with quantities or levels",
                        "keep one of the two");
        return made;
    }
    for (const auto& [item, pointer] : entry.list("quantities")) {
        made.quantities.push_back(quantity_from({item, pointer, faults}));
        if (made.quantities.back().limit.has_value() != of.contains("levels"))
            faults.push_back({pointer + "/limit", "goes with levels of the case",
                              "give both, or neither: an order of convergence needs both"});
    }
    if (!of.contains("levels")) return made;
    for (const auto& [item, pointer] : entry.list("levels"))
        made.levels.push_back(level_from({item, pointer, faults}));
    if (made.levels.size() < 3)
        entry.blame("levels", "are " + std::to_string(made.levels.size()),
                    "give three at least: two errors always lie on a line");
    return made;
}

Topic topic_in(const fs::path& path) {
    std::ifstream stream(path);
    const json file = json::parse(stream, nullptr, false);
    if (!file.is_object())
        throw fault::BadInput(path.string(), {{"", "is not a JSON object", "write one"}});
    std::vector<fault::Fault> faults;
    Entry entry(file, "", faults);
    entry.only({"title", "text", "program", "commands", "cases"});
    Topic made{.id = path.stem().string(),
               .title = entry.text("title", "name it"),
               .text = file.value("text", ""),
               .cases = {}};
    try {
        for (const auto& [item, pointer] : entry.list("cases"))
            made.cases.push_back(
                case_from({item, pointer, faults}, file, path.parent_path(), faults));
    } catch (const json::exception& wrong) {
        faults.push_back({"/cases", wrong.what(), "see the cases that are shipped"});
    }
    if (!faults.empty()) throw fault::BadInput(path.string(), std::move(faults));
    return made;
}

}  // namespace

std::vector<Topic> catalogue_in(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& each : fs::directory_iterator(folder))
        if (each.path().extension() == ".json") files.push_back(each.path());
    std::ranges::sort(files);
    std::vector<Topic> topics;
    std::set<std::string> ids;
    for (const fs::path& each : files) {
        topics.push_back(topic_in(each));
        for (const Case& one : topics.back().cases)
            if (!ids.insert(one.id).second)
                throw fault::BadInput(
                    each.string(),
                    {{"/cases", "has a second case \"" + one.id + "\"", "name it otherwise"}});
    }
    if (topics.empty())
        throw fault::BadInput(folder.string(),
                              {{"", "holds no catalogue", "give a folder of *.json"}});
    return topics;
}

}  // namespace breach::verify

#include "core/scene/schema.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <unordered_map>
#include <utility>

#include "core/scene/slips.hpp"
#include "core/words/encoding.hpp"
#include "core/words/nearest.hpp"

namespace breach::scene {

using fault::Fault;
using fault::Flag;
using nlohmann::json;

namespace {

constexpr std::size_t deepest_nesting = 64;
// In one object, and in a list whose schema has no limit: far above those of any document.
constexpr std::size_t most_keys = 10'000;
constexpr std::size_t most_items = 100'000;
constexpr std::size_t longest_key = 200;  // every fault below a key repeats it

std::string escaped(const std::string& token) {
    std::string out;
    for (const char c : token) {
        if (c == '~') {
            out += "~0";
        } else if (c == '/') {
            out += "~1";
        } else {
            out += c;
        }
    }
    return out;
}

/// Faults and overrides join names to JSON pointers without escapes.
bool can_be_pointed_at(const std::string& key) { return key.find_first_of("/~") == key.npos; }

std::string listed(const json& values) {
    std::string text;
    for (const json& value : values) text += (text.empty() ? "" : ", ") + value.dump();
    return text;
}

bool is_of_type(const json& value, const std::string& type) {
    if (type == "object") return value.is_object();
    if (type == "array") return value.is_array();
    if (type == "string") return value.is_string();
    if (type == "boolean") return value.is_boolean();
    if (type == "number") return value.is_number();
    if (type == "integer") {
        return value.is_number_integer() ||
               (value.is_number_float() &&
                std::nearbyint(value.get<double>()) == value.get<double>());
    }
    return false;
}

const json* entry_of(const json& object, const char* key) {
    const auto found = object.find(key);
    return found == object.end() ? nullptr : &*found;
}

/// Cache: the schemas have few patterns, documents many strings.
const std::regex& compiled(const std::string& pattern) {
    thread_local std::map<std::string, std::regex> known;
    const auto found = known.find(pattern);
    return found != known.end()
               ? found->second
               : known
                     .emplace(pattern,
                              std::regex(pattern, std::regex::ECMAScript | std::regex::nosubs))
                     .first->second;
}

/// Traverses document and schema together; fills in defaults, collects faults and warnings.
class Walker {
  public:
    explicit Walker(const json& root) : root_(root) {}

    void visit(json& value, const json& schema_or_ref, const std::string& pointer) {
        const json& schema = resolved(schema_or_ref);
        if (const json* alternatives = entry_of(schema, "oneOf")) {
            if (const json* chosen = choose(value, *alternatives, pointer)) {
                visit(value, *chosen, pointer);
            }
            return;
        }
        if (const json* only = entry_of(schema, "const"); only && value != *only) {
            add(pointer, [&] { return Words{"is " + brief(value), "must be " + only->dump()}; });
            return;
        }
        if (const json* type = entry_of(schema, "type"); type && !is_of_type(value, *type)) {
            add(pointer, [&] {
                return Words{"is " + brief(value),
                             "must be of type " + type->get<std::string>() + meaning(schema)};
            });
            return;
        }
        if (schema.contains("enum")) check_enum(value, schema, pointer);
        if (value.is_number()) check_number(value, schema, pointer);
        if (value.is_string()) check_string(value, schema, pointer);
        if (value.is_array()) visit_array(value, schema, pointer);
        if (value.is_object()) visit_object(value, schema, pointer);
    }

    fault::FirstFaults found;
    std::vector<Flag> warnings;  ///< possible but implausible numbers

  private:
    using Words = std::pair<std::string, std::string>;  ///< cause, remedy

    const json& resolved(const json& schema) {
        const json* reference = entry_of(schema, "$ref");
        if (!reference) return schema;
        const json*& known = targets_[reference];
        if (known == nullptr)
            known =
                &root_.at(json::json_pointer(reference->get_ref<const std::string&>().substr(1)));
        return *known;
    }

    /// words: returns {cause, remedy}. Not called for faults beyond the first: a document may have
    /// millions.
    template <class Words>
    void add(const std::string& pointer, Words words) {
        if (found.is_full()) return found.add({});
        auto [cause, remedy] = words();
        found.add({pointer, std::move(cause), std::move(remedy)});
    }

    static std::string brief(const json& value) {
        const std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
        return text.size() <= 60 ? text : text.substr(0, 57) + "...";
    }

    /// " [unit]: description", if the schema has them.
    static std::string meaning(const json& schema) {
        std::string text;
        if (schema.contains("unit") && schema.at("unit") != "1") {
            text += " [" + schema.at("unit").get<std::string>() + "]";
        }
        if (schema.contains("description"))
            text += ": " + schema.at("description").get<std::string>();
        return text;
    }

    void check_enum(const json& value, const json& schema, const std::string& pointer) {
        const json& allowed = schema.at("enum");
        if (std::find(allowed.begin(), allowed.end(), value) != allowed.end()) return;
        add(pointer, [&] {
            return Words{"is " + brief(value),
                         "must be one of " + listed(allowed) + meaning(schema)};
        });
    }

    void check_number(const json& value, const json& schema, const std::string& pointer) {
        const double number = value.get<double>();
        bool possible = true;
        const auto limit = [&](const char* key, auto violated, const char* sign) {
            const json* bound = entry_of(schema, key);
            if (!bound || !violated(number, bound->get<double>())) return;
            add(pointer, [&] {
                const std::string slip = likely_slip(number, schema, root_);
                return Words{"is " + brief(value), "must be " + std::string(sign) + " " +
                                                       bound->dump() + meaning(schema) +
                                                       (slip.empty() ? "" : "; " + slip)};
            });
            possible = false;
        };
        limit("minimum", std::less<>(), ">=");
        limit("exclusiveMinimum", std::less_equal<>(), ">");
        limit("maximum", std::greater<>(), "<=");
        limit("exclusiveMaximum", std::greater_equal<>(), "<");
        if (!possible) return;
        if (auto warn = warning_about(number, schema, root_)) {
            warnings.push_back(
                {"implausible", fault::Severity::warning, std::move(*warn), pointer});
        }
    }

    void check_string(const json& value, const json& schema, const std::string& pointer) {
        const auto& text = value.get_ref<const std::string&>();
        if (schema.contains("minLength") &&
            text.size() < schema.at("minLength").get<std::size_t>()) {
            add(pointer, [&] {
                return Words{"is too short", "give at least " + schema.at("minLength").dump() +
                                                 " characters" + meaning(schema)};
            });
        }
        const json* pattern = entry_of(schema, "pattern");
        if (pattern && !std::regex_search(text, compiled(pattern->get_ref<const std::string&>()))) {
            add(pointer, [&] {
                return Words{"is " + brief(value),
                             "must match " + pattern->get<std::string>() + meaning(schema)};
            });
        }
    }

    void visit_array(json& value, const json& schema, const std::string& pointer) {
        if (schema.contains("minItems") &&
            value.size() < schema.at("minItems").get<std::size_t>()) {
            add(pointer, [&] {
                return Words{"has " + std::to_string(value.size()) + " items",
                             "needs at least " + schema.at("minItems").dump() + meaning(schema)};
            });
        }
        const std::size_t most = schema.value("maxItems", most_items);
        if (value.size() > most) {
            add(pointer, [&] {
                return Words{"has " + std::to_string(value.size()) + " items",
                             "takes at most " + std::to_string(most) + meaning(schema)};
            });
        }
        if (!schema.contains("items")) return;
        for (std::size_t i = 0; i < std::min(most, value.size()); ++i) {
            visit(value[i], schema.at("items"), pointer + "/" + std::to_string(i));
        }
    }

    void visit_object(json& value, const json& schema, const std::string& pointer) {
        static const json none = json::object();
        const json& properties = schema.contains("properties") ? schema.at("properties") : none;
        visit_members(value, schema, properties, pointer);
        if (schema.contains("required")) require(value, schema, properties, pointer);
        if (schema.contains("minProperties") &&
            value.size() < schema.at("minProperties").get<std::size_t>()) {
            add(pointer, [&] {
                return Words{"is empty", "needs at least one entry" + meaning(schema)};
            });
        }
        for (const auto& [key, property] : properties.items()) {
            if (value.contains(key) || !resolved(property).contains("default")) continue;
            value[key] = resolved(property).at("default");
            visit(value[key], property, pointer + "/" + escaped(key));
        }
    }

    void visit_members(json& value, const json& schema, const json& properties,
                       const std::string& pointer) {
        for (auto& [key, member] : value.items()) {
            const std::string here = pointer + "/" + escaped(key);
            if (const json* property = entry_of(properties, key.c_str())) {
                visit(member, *property, here);
            } else if (!schema.contains("additionalProperties")) {
                continue;
            } else if (schema.at("additionalProperties").is_object()) {
                visit(member, schema.at("additionalProperties"), here);
            } else {
                add(here, [&] { return Words{"is not a known key", suggestion(key, properties)}; });
            }
        }
    }

    void require(const json& value, const json& schema, const json& properties,
                 const std::string& pointer) {
        for (const json& key : schema.at("required")) {
            if (value.contains(key.get<std::string>())) continue;
            add(pointer, [&] {
                return Words{"lacks \"" + key.get<std::string>() + "\"",
                             "add it" + meaning(resolved(properties.at(key.get<std::string>())))};
            });
        }
    }

    static std::string suggestion(const std::string& key, const json& properties) {
        std::vector<std::string> names;
        std::string all;
        for (const auto& [name, property] : properties.items()) {
            names.push_back(name);
            all += (all.empty() ? "" : ", ") + name;
        }
        if (const std::string nearest = words::nearest(key, names); !nearest.empty())
            return "did you mean \"" + nearest + "\"?";
        return "remove it; known keys here: " + all;
    }

    /// Chooses the alternative for a value by its "type" entry, or by its JSON type.
    const json* choose(const json& value, const json& alternatives, const std::string& pointer) {
        std::string known;
        for (const json& each : alternatives) {
            const json& candidate = resolved(each);
            if (const auto tag = tag_of(candidate)) {
                known += (known.empty() ? "" : ", ") + tag->dump();
                if (value.is_object() && value.contains("type") && value.at("type") == *tag)
                    return &candidate;
            } else if (is_of_type(value, candidate.at("type"))) {
                return &candidate;
            } else {
                known += (known.empty() ? "" : " or ") + candidate.at("type").get<std::string>();
            }
        }
        if (value.is_object() && value.contains("type")) {
            add(pointer + "/type", [&] {
                return Words{"is " + brief(value.at("type")), "must be one of " + known};
            });
        } else if (value.is_object()) {
            add(pointer, [&] { return Words{"lacks \"type\"", "add it; known: " + known}; });
        } else {
            add(pointer, [&] { return Words{"is " + brief(value), "must be: " + known}; });
        }
        return nullptr;
    }

    static const json* tag_of(const json& schema) {
        if (!schema.contains("properties") || !schema.at("properties").contains("type"))
            return nullptr;
        const json& type = schema.at("properties").at("type");
        return type.contains("const") ? &type.at("const") : nullptr;
    }

    const json& root_;
    std::unordered_map<const json*, const json*> targets_;  ///< of the references seen so far
};

void check_encoding(std::string_view text, const std::string& file) {
    if (const std::string encoding = words::wide_encoding(text); !encoding.empty())
        throw fault::BadInput(file, {{"", "is " + encoding + " text, and JSON is UTF-8",
                                      words::as_utf8_remedy(encoding)}});
    if (text.find('\0') != std::string_view::npos)
        throw fault::BadInput(
            file, {{"", "holds zero bytes: it is no text", "give the JSON text, uncompressed"}});
    const std::size_t at = words::first_not_utf8(text);
    if (at == std::string_view::npos) return;
    const auto line = 1 + std::ranges::count(text.substr(0, at), '\n');
    throw fault::BadInput(file, {{"",
                                  "is not UTF-8 text (line " + std::to_string(line) +
                                      "): it looks like Latin-1 (ISO-8859-1)",
                                  words::as_utf8_remedy("ISO-8859-1")}});
}

/// The parser's message, without an incomplete character at its end.
std::string words_of(const json::exception& error) {
    std::string text = error.what();
    for (std::size_t at = 0; (at = words::first_not_utf8(text)) != std::string::npos;)
        text.erase(at, 1);
    return text;
}

/// Makes the document while it is parsed. Sees every key, also a second one in an object.
class Maker : public json::json_sax_t {
  public:
    explicit Maker(const std::string& file) : file_(file) {}

    bool null() override { return place(nullptr); }
    bool boolean(bool value) override { return place(value); }
    bool number_integer(json::number_integer_t value) override { return place(value); }
    bool number_unsigned(json::number_unsigned_t value) override { return place(value); }
    bool number_float(json::number_float_t value, const std::string&) override {
        return place(value);
    }
    bool string(std::string& value) override { return place(std::move(value)); }
    bool binary(json::binary_t&) override { return false; }  // not in texts
    bool start_object(std::size_t) override { return begin(json::object()); }
    bool start_array(std::size_t) override { return begin(json::array()); }
    bool end_object() override { return end(); }
    bool end_array() override { return end(); }

    bool key(std::string& key) override {
        if (key.size() > longest_key)
            refuse("has a key of " + std::to_string(key.size()) + " characters: \"" + key + '"',
                   "keys have at most " + std::to_string(longest_key));
        if (!can_be_pointed_at(key))
            found.add({"", "has the key \"" + key + "\" with / or ~ in it",
                       "name it without: messages name entries by their path, /materials/sand"});
        auto& members = open_.back()->get_ref<json::object_t&>();
        next_ = &dropped_;
        if (members.size() >= most_keys) {
            found.add({"",
                       "has the key \"" + key + "\" in an object that has " +
                           std::to_string(most_keys) + " keys before it",
                       "remove it"});
            return true;
        }
        const auto [member, is_new] = members.try_emplace(std::move(key));
        if (!is_new)
            found.add({"", "has the key \"" + member->first + "\" twice in one object",
                       "keep one of them"});
        next_ = &member->second;
        return true;
    }

    bool parse_error(std::size_t, const std::string&, const json::exception& error) override {
        refuse("is not valid JSON: " + words_of(error), "correct the text at this place");
    }

    json document;
    fault::FirstFaults found;

  private:
    [[noreturn]] void refuse(std::string cause, std::string remedy) const {
        throw fault::BadInput(file_, {{"", std::move(cause), std::move(remedy)}});
    }
    /// The value's place: below its key, at the end of an array, or the whole document.
    json& placed(json&& value) {
        if (open_.empty()) return document = std::move(value);
        if (open_.back()->is_object()) return *next_ = std::move(value);
        return open_.back()->get_ref<json::array_t&>().emplace_back(std::move(value));
    }
    bool place(json&& value) {
        placed(std::move(value));
        return true;
    }
    bool begin(json&& value) {
        open_.push_back(&placed(std::move(value)));
        if (open_.size() > deepest_nesting)
            refuse("is nested deeper than " + std::to_string(deepest_nesting) + " levels",
                   "flatten it");
        return true;
    }
    bool end() {
        open_.pop_back();
        return true;
    }

    const std::string& file_;
    std::vector<json*> open_;  ///< objects and arrays around the next value
    json* next_ = nullptr;     ///< place of the last key's value
    json dropped_;             ///< place of a value that is not kept
};

}  // namespace

json parse_json(std::string_view text, const std::string& file) {
    check_encoding(text, file);
    Maker maker(file);
    json::sax_parse(text, &maker);
    auto& [faults, more] = maker.found;
    if (!faults.empty()) throw fault::BadInput(file, std::move(faults), more);
    return std::move(maker.document);
}

std::optional<Fault> missing_parent(const json& document, const std::string& pointer) {
    const json* at = &document;
    for (std::size_t start = 1; start < pointer.size();) {
        const std::string path = pointer.substr(0, start - 1);
        const std::size_t end = std::min(pointer.find('/', start), pointer.size());
        const std::string token = pointer.substr(start, end - start);
        const bool is_last = end == pointer.size();
        if (at->is_array()) {
            if (token.empty() || token.find_first_not_of("0123456789") != std::string::npos)
                return std::nullopt;
            const std::size_t place = token.size() > 9 ? 999'999'999 : std::stoul(token);
            const std::size_t size = at->size();
            if (place > size) {
                const std::string name = path.substr(path.rfind('/') + 1);
                const std::string entries = name.ends_with('s') ? name : "entries";
                return Fault{pointer,
                             "there is no " + path + "/" + token + ": " + path + " has " +
                                 (size == 0 ? "no " + entries
                                            : std::to_string(size) + " " + entries + ", 0 to " +
                                                  std::to_string(size - 1)),
                             "name one that exists, or append one as a whole: " + path + "/-=..."};
            }
            if (place == size) return std::nullopt;  // appends one entry
            at = &(*at)[place];
        } else if (at->is_object()) {
            const auto found = at->find(token);
            if (found == at->end()) {
                if (path != "/materials" || is_last) return std::nullopt;
                std::vector<std::string> names;
                std::string all;
                for (const auto& [name, material] : at->items()) {
                    names.push_back(name);
                    all += (all.empty() ? "" : ", ") + name;
                }
                const std::string nearest = words::nearest(token, names);
                return Fault{pointer, "there is no material \"" + token + "\"",
                             nearest.empty()
                                 ? "the materials are " + all +
                                       "; give a new one as a whole: /materials/" + token + "={...}"
                                 : "did you mean \"" + nearest + "\"?"};
            }
            at = &*found;
        } else {
            return std::nullopt;
        }
        start = end + 1;
    }
    return std::nullopt;
}

std::vector<Fault> apply_override(json& document, const std::string& assignment) {
    const std::size_t equals = assignment.find('=');
    const Fault malformed{"", "--set " + assignment + " is not an assignment",
                          "write --set /json/pointer=value"};
    if (equals == std::string::npos || assignment.empty() || assignment[0] != '/')
        return {malformed};
    const std::string pointer = assignment.substr(0, equals);
    if (pointer.find('~') != std::string::npos)
        return {{pointer, "has a ~, which no entry's name has", "name an entry that exists"}};
    if (auto missing = missing_parent(document, pointer)) return {std::move(*missing)};
    const std::string text = assignment.substr(equals + 1);
    json value = json::parse(text, nullptr, false);
    if (value.is_discarded()) value = text;
    try {
        document[json::json_pointer(pointer)] = std::move(value);
    } catch (const json::exception&) {
        return {{pointer, "cannot be set: no object or list that could hold it is there",
                 "name an entry that exists, or a new key of an existing object"}};
    }
    return {};
}

std::vector<Fault> complete_and_check(json& document, const json& schema, const std::string& file,
                                      std::vector<Flag>& warnings) {
    Walker walker(schema);
    walker.visit(document, schema, "");
    auto& [faults, more] = walker.found;
    if (more > 0) throw fault::BadInput(file, std::move(faults), more);
    warnings = std::move(walker.warnings);
    return std::move(faults);
}

std::vector<Fault> complete_and_check(json& document, const json& schema, const std::string& file) {
    std::vector<Flag> warnings;
    return complete_and_check(document, schema, file, warnings);
}

}  // namespace breach::scene

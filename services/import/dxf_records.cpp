// Splits a DXF file into records of (code, value) pairs. A record ends where the next code 0
// begins, so one group is read ahead (ahead_). A broken file ends the reading with its line
// number.
#include "services/import/dxf_records.hpp"

#include <charconv>
#include <optional>

#include "core/words/encoding.hpp"
#include "services/import/numbers.hpp"

namespace breach::importing {

namespace {

constexpr const char* again =
    "export the drawing again, as DXF in text form (R12 or 2000 and later)";
/// A file without code 0 would otherwise become one record of any size.
constexpr std::size_t most_groups = 1'000'000;  // of one record
constexpr int largest_code = 1071;

/// Group codes end at 1071. Binary rubbish fails here, at its first line.
std::optional<int> code_in(std::string_view text) {
    text = trimmed(text);
    int code = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), code);
    if (error != std::errc() || end != text.data() + text.size() || code < -5 ||
        code > largest_code)
        return std::nullopt;
    return code;
}

}  // namespace

/// What users send instead of DXF text: a binary export, the DWG itself (it begins with AC10 and
/// the version), a file saved as UTF-16.
std::vector<Fault> form_faults(std::string_view bytes) {
    if (bytes.starts_with("AutoCAD Binary DXF"))
        return {{at_line(1), "is DXF in binary form", "save it as DXF in text (ASCII) form"}};
    if (bytes.starts_with("AC10"))
        return {{at_line(1), "is a DWG drawing", "save it as DXF in text (ASCII) form"}};
    if (const std::string encoding = words::wide_encoding(bytes); !encoding.empty())
        return {{at_line(1), "is " + encoding + " text", words::as_utf8_remedy(encoding)}};
    if (const std::size_t at = bytes.find('\0'); at != std::string_view::npos)
        return {{"byte " + std::to_string(at), "holds a NUL byte: it is no text", again}};
    if (trimmed(bytes.substr(0, 4096)).find_first_not_of('\n') == std::string_view::npos)
        return {{at_line(1), "is empty", again}};
    return {};
}

Records::Records(std::string_view text) : rest_(text) {
    if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);
}

bool Records::stop(std::size_t line, std::string cause, std::string remedy) {
    ended_ = true;
    faults_.push_back({at_line(line), std::move(cause), std::move(remedy)});
    return false;
}

bool Records::read(Group& group) {
    const auto take_line = [&]() -> std::optional<std::string_view> {
        if (rest_.empty()) return std::nullopt;
        const std::size_t end = rest_.find('\n');
        const std::string_view line = rest_.substr(0, end);
        rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
        ++line_;
        return trimmed(line);
    };
    const auto code_line = take_line();
    if (!code_line || (code_line->empty() && trimmed(rest_).empty()))
        return stop(line_, "ends without EOF: the file is cut off", again);
    const auto code = code_in(*code_line);
    if (!code)
        return stop(line_,
                    "\"" + as_utf8(code_line->substr(0, 20)) + "\" is no group code of a DXF file",
                    again);
    const auto value = take_line();
    if (!value) return stop(line_, "ends within a group: the file is cut off", again);
    group = {*code, *value, line_};
    return true;
}

bool Records::next(Record& record) {
    record.groups.clear();
    if (ended_) return false;
    if (!has_ahead_) {
        do {
            if (!read(ahead_)) return false;
        } while (ahead_.code == 999);  // comments
        if (ahead_.code != 0)
            return stop(
                ahead_.line - 1,
                "begins with group code " + std::to_string(ahead_.code) + " where a section begins",
                again);
    }
    record.type = ahead_.value;
    record.line = ahead_.line;
    has_ahead_ = false;
    if (record.type == "EOF") {
        ended_ = true;
        return false;
    }
    Group group{};
    while (read(group)) {
        if (group.code == 0) {
            ahead_ = group;
            has_ahead_ = true;
            return true;
        }
        if (group.code == 999) continue;
        if (record.groups.size() == most_groups)
            return stop(group.line, "one entity of more than a million groups", again);
        record.groups.push_back(group);
    }
    return true;  // the rest of a truncated file
}

}  // namespace breach::importing

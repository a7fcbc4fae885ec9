#include "core/fault/fault.hpp"

#include <algorithm>

namespace breach::fault {

namespace {

constexpr std::size_t longest_text = 1000;
constexpr std::size_t longest_list = 88'000;  // [bytes] in JSON, with room for the keys

/// Drops the middle of a long text, at the boundaries of UTF-8 characters.
std::string shortened(std::string text) {
    if (text.size() <= longest_text) return text;
    const auto continues = [&](std::size_t i) { return (text[i] & 0xC0) == 0x80; };
    std::size_t end = longest_text / 2, begin = text.size() - longest_text / 4;
    while (end > 0 && continues(end)) --end;
    while (begin < text.size() && continues(begin)) ++begin;
    return text.substr(0, end) + " ... " + text.substr(begin);
}

/// Size in JSON, where a control character takes six bytes.
std::size_t size_of(const std::string& text) {
    std::size_t size = text.size();
    for (const char c : text) size += c >= 0 && c < ' ' ? 5 : c == '"' || c == '\\' ? 1 : 0;
    return size;
}

FirstFaults kept_of(std::vector<Fault> faults, std::size_t more) {
    FirstFaults kept{.faults = {}, .more = more};
    std::size_t size = 0;
    for (Fault& each : faults) {
        if (kept.more > more || kept.is_full()) {
            ++kept.more;
            continue;
        }
        Fault next{shortened(std::move(each.pointer)), shortened(std::move(each.cause)),
                   shortened(std::move(each.remedy))};
        size += size_of(next.pointer) + size_of(next.cause) + size_of(next.remedy);
        if (size > longest_list)
            ++kept.more;
        else
            kept.faults.push_back(std::move(next));
    }
    return kept;
}

std::string count_of(const FirstFaults& kept) {
    const std::size_t all = kept.faults.size() + kept.more;
    std::string text = std::to_string(all) + (all == 1 ? " fault" : " faults");
    if (kept.more > 0)
        text += ", of which these are the first " + std::to_string(kept.faults.size());
    return text;
}

std::string list_all(const std::string& file, const FirstFaults& kept) {
    std::string text = file + ": " + count_of(kept);
    for (const Fault& each : kept.faults) {
        text += "\n  " + (each.pointer.empty() ? "/" : each.pointer) + ": " + each.cause;
        if (!each.remedy.empty()) text += "\n      remedy: " + each.remedy;
    }
    return text;
}

}  // namespace

BadInput::BadInput(std::string file, std::vector<Fault> faults, std::size_t more)
    : BadInput(std::move(file), kept_of(std::move(faults), more)) {}

BadInput::BadInput(std::string file, FirstFaults kept)
    : std::runtime_error(list_all(file, kept)), file_(std::move(file)), kept_(std::move(kept)) {}

std::string BadInput::count() const { return count_of(kept_); }

}  // namespace breach::fault

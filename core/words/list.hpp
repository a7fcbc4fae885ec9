// Names in a sentence, separated by commas: what a message lists as known, missing or given.
#pragma once

#include <functional>
#include <string>

namespace breach::words {

/// "a, b"; empty for none. `name`: a member or function that gives the name of an element.
template <class Elements, class Name = std::identity>
std::string list_of(const Elements& elements, Name name = {}) {
    std::string list;
    for (const auto& each : elements)
        list += (list.empty() ? "" : ", ") + std::string(std::invoke(name, each));
    return list;
}

}  // namespace breach::words

// Words of an enum for entries, results and plans: one table per enum, found by the enum's type, in
// the enum's namespace:
//
//     constexpr auto words_of(Wall) {
//         return words::in_order<Wall>({{Wall::roller, "roller"}, {Wall::open, "open"}});
//     }
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace breach::words {

template <class Enum>
struct Word {
    Enum value;
    std::string_view word;
};

/// The table of an enum. Compiles only if it is in the enum's order.
template <class Enum, std::size_t n>
consteval std::array<Word<Enum>, n> in_order(const Word<Enum> (&list)[n]) {
    for (std::size_t i = 0; i < n; ++i)
        if (static_cast<std::size_t>(list[i].value) != i)
            throw std::logic_error("a value is missing, or the order is another");
    return std::to_array(list);
}

template <class Enum>
concept Worded = requires {
    words_of(Enum{});
};

/// All values, in the enum's order.
template <Worded Enum>
inline constexpr auto values = [] {
    constexpr auto table = words_of(Enum{});
    std::array<Enum, table.size()> all{};
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = table[i].value;
    return all;
}();

template <Worded Enum>
constexpr std::string_view name_of(Enum value) {
    return words_of(value).at(static_cast<std::size_t>(value)).word;
}

/// None: not a word of the enum.
template <Worded Enum>
constexpr std::optional<Enum> find(std::string_view word) {
    for (const Enum each : values<Enum>)
        if (name_of(each) == word) return each;
    return std::nullopt;
}

/// The value of a checked word; an unknown word is a programming error.
template <Worded Enum>
Enum named(std::string_view word) {
    if (const auto found = find<Enum>(word)) return *found;
    throw std::logic_error("nothing reads the word \"" + std::string(word) + "\"");
}

/// The value of an entry in a checked JSON object.
template <Worded Enum, class Object>
Enum word_at(const Object& object, const char* key) {
    return named<Enum>(object.at(key).template get_ref<const std::string&>());
}

}  // namespace breach::words

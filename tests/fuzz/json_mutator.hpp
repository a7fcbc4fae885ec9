// Mutates a JSON document as a tree, because random changes of bytes rarely give JSON. Only for
// libFuzzer.
#pragma once

#include <nlohmann/json.hpp>
#include <random>

#include "tests/fuzz/fuzz.hpp"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace breach::fuzz {

using nlohmann::json;

inline void collect(json& node, std::vector<json*>& nodes) {
    nodes.push_back(&node);
    if (node.is_structured())
        for (auto& [key, child] : node.items()) collect(child, nodes);
}

inline json odd_value(std::minstd_rand& random) {
    static const json values = json::array({0,
                                            -1,
                                            1,
                                            1e308,
                                            -1e308,
                                            1e-308,
                                            5e-324,
                                            9223372036854775807,
                                            -2147483649,
                                            1e-12,
                                            0.5,
                                            1e6,
                                            true,
                                            false,
                                            nullptr,
                                            "",
                                            "/",
                                            "\xc3\xa9",
                                            1000,
                                            json::array(),
                                            json::object(),
                                            json::array({json::array({0, 0})})});
    return values[random() % values.size()];
}

/// One change: another value, a value from elsewhere, an entry removed, duplicated or scaled.
inline void change(json& document, std::minstd_rand& random) {
    std::vector<json*> nodes;
    collect(document, nodes);
    json& node = *nodes[random() % nodes.size()];
    switch (random() % 5) {
        case 0:
            node = odd_value(random);
            break;
        case 1: {
            const json other = *nodes[random() % nodes.size()];
            node = other;
            break;
        }
        case 2:
            if (node.is_array() && !node.empty()) node.erase(random() % node.size());
            if (node.is_object() && !node.empty())
                node.erase(std::next(node.begin(), static_cast<long>(random() % node.size())));
            break;
        case 3:
            if (node.is_array() && !node.empty()) {
                const json entry = node[random() % node.size()];
                node.push_back(entry);
            }
            break;
        default:
            if (node.is_number())
                node = node.get<double>() * std::ldexp(1.0, static_cast<int>(random() % 9) - 4);
    }
}

inline std::size_t mutate_json(std::uint8_t* data, std::size_t size, std::size_t most,
                               unsigned seed) {
    std::minstd_rand random(seed);
    json document = json::parse(text_of(data, size), nullptr, false);
    if (document.is_discarded() || random() % 8 == 0) return LLVMFuzzerMutate(data, size, most);
    for (auto changes = 1 + random() % 3; changes > 0; --changes) change(document, random);
    const std::string text = document.dump(-1, ' ', false, json::error_handler_t::replace);
    if (text.size() > most) return LLVMFuzzerMutate(data, size, most);
    std::ranges::copy(text, data);
    return text.size();
}

}  // namespace breach::fuzz

#ifdef BREACH_FUZZ
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
    return breach::fuzz::mutate_json(data, size, most, seed);
}
#endif

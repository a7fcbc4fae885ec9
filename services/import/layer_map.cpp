// What each layer of a drawing means: told by the user (`told`), else by the name of a material.
// The last "=" separates, as a layer's name may contain one. Names are compared in lower case, as
// CAD programs do.
#include "services/import/layer_map.hpp"

#include <optional>

#include "core/words/list.hpp"

namespace breach::importing {

namespace {

/// Only English words: a layer of another name is mapped by the user.
std::optional<Role> line_named(const std::string& word) {
    if (word == "phreatic" || word == "phreatic_line" || word == "phreatic line")
        return Role::phreatic;
    if (word == "terrain") return Role::terrain;
    if (word == "ground") return Role::ground;
    if (word == "none") return Role::none;
    return std::nullopt;
}

}  // namespace

LayerMap::LayerMap(const std::vector<std::string>& entries, const std::set<std::string>& materials,
                   std::vector<Fault>& faults) {
    for (const std::string& each : materials) own_[lower(each)] = each;
    for (const std::string& each : entries) {
        const std::size_t split = each.rfind('=');
        if (split == std::string::npos || split == 0 || split + 1 == each.size()) {
            faults.push_back({"map", "\"" + as_utf8(each) + "\" maps nothing",
                              "write LAYER=material, or LAYER=phreatic, terrain, ground or none"});
            continue;
        }
        const std::string layer = lower(as_utf8(each.substr(0, split)));
        const std::string word = as_utf8(each.substr(split + 1));
        if (const auto line = line_named(lower(word))) {
            told_[layer] = {*line, "", true};
        } else if (materials.contains(word)) {
            told_[layer] = {Role::soil, word, true};
        } else if (const auto own = own_.find(lower(word)); own != own_.end()) {
            told_[layer] = {Role::soil, own->second, true};
        } else {
            const std::string all = words::list_of(materials);
            faults.push_back({"map",
                              "\"" + as_utf8(each) + "\": there is no material \"" + word + "\"",
                              "the materials are " + (all.empty() ? "none" : all)});
            told_[layer] = {Role::none, "", true};  // one fault is enough
        }
    }
}

Meaning LayerMap::meaning_of(const std::string& layer) const {
    const std::string name = lower(layer);
    if (const auto found = told_.find(name); found != told_.end()) return found->second;
    if (const auto found = own_.find(name); found != own_.end())
        return {Role::soil, found->second, false};
    if (name == "defpoints") return {Role::none};  // CAD never plots this layer
    // A layer that happens to be named "none" was not left out by anybody: it needs a meaning.
    if (name == "none") return {};
    if (const auto line = line_named(name)) return {*line};
    return {};
}

std::vector<std::string> LayerMap::unused(const std::set<std::string>& layers) const {
    std::set<std::string> drawn;
    for (const std::string& each : layers) drawn.insert(lower(each));
    std::vector<std::string> missing;
    for (const auto& [layer, meaning] : told_)
        if (!drawn.contains(layer)) missing.push_back(layer);
    return missing;
}

}  // namespace breach::importing

// Cuts regions along the phreatic line moved down by each depth. The cut runs through the same
// overlay as healing (arrangement.cpp), so that neighbours get its vertices. Called by fit() in
// steps.cpp once per request, on soils that are healed.
#include "services/import/depth_layers.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/geometry/polyline.hpp"
#include "core/words/list.hpp"
#include "services/import/numbers.hpp"

namespace breach::importing {

namespace {

/// 2.5 becomes "2p5": the name of a region appears in file names and tables.
std::string short_text(double depth) {
    std::string digits = std::to_string(depth);
    digits.erase(digits.find_last_not_of('0') + 1);
    if (digits.back() == '.') digits.pop_back();
    std::ranges::replace(digits, '.', 'p');  // names contain no dots
    return digits;
}

/// "_above", "_0_5", "_5_10", "_below_10"; "_below" without depths. The number of a part is
/// Soil::depth_layer.
std::string part_name(const LayerRequest& request, std::size_t part) {
    if (part == 0) return "_above";
    if (request.depths.empty()) return "_below";
    if (part > request.depths.size()) return "_below_" + short_text(request.depths.back());
    const double from = part == 1 ? 0.0 : request.depths[part - 2];
    return "_" + short_text(from) + "_" + short_text(request.depths[part - 1]);
}

/// Depth is measured vertically.
std::size_t part_at(const LayerRequest& request, const std::vector<Vec2>& line, const Vec2& place) {
    const double depth = geometry::level_at(line, place.x()) - place.y();
    if (depth < 0.0) return 0;
    std::size_t part = 1;
    while (part <= request.depths.size() && depth > request.depths[part - 1]) ++part;
    return part;
}

/// The line lowered by `depth` and extended horizontally to both sides of the ring.
/// Moved down, not parallel: hydrostatic pressure depends on the vertical distance to the line.
std::vector<Vec2> lowered(const std::vector<Vec2>& line, double depth, const Polygon& ring) {
    const geometry::Box box = geometry::bounding_box(ring);
    const double aside = 1.0 + (box.high - box.low).norm();
    std::vector<Vec2> low;
    const double from = std::min(box.low.x(), line.front().x()) - aside;
    const double to = std::max(box.high.x(), line.back().x()) + aside;
    low.emplace_back(from, line.front().y() - depth);
    for (const Vec2& each : line) low.emplace_back(each.x(), each.y() - depth);
    low.emplace_back(to, line.back().y() - depth);
    return low;
}

/// The parts of a line inside the ring.
/// Tested at the middle of each stretch: its ends lie on the ring, where inside is undecided.
std::vector<Chain> inside_of(const Polygon& ring, const std::vector<Vec2>& line) {
    std::vector<Chain> chains;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Vec2 &a = line[i], &b = line[i + 1];
        std::vector<double> shares{0.0, 1.0};
        const Vec2 along = b - a;
        for (std::size_t k = 0; k < ring.size(); ++k) {
            const auto cross = geometry::crossing(a, b, ring[k], ring[(k + 1) % ring.size()]);
            if (!cross) continue;
            const double s = cross->on_first, t = cross->on_second;
            if (s > 0.0 && s < 1.0 && t >= 0.0 && t <= 1.0) shares.push_back(s);
        }
        std::ranges::sort(shares);
        for (std::size_t k = 0; k + 1 < shares.size(); ++k) {
            const Vec2 from = a + shares[k] * along, to = a + shares[k + 1] * along;
            if (shares[k + 1] - shares[k] <= 0.0 || !geometry::contains(ring, 0.5 * (from + to)))
                continue;
            if (chains.empty() || chains.back().points.back() != from)
                chains.push_back({{from}, false});
            chains.back().points.push_back(to);
        }
    }
    return chains;
}

/// All outlines with the cuts on common nodes, and the faces between them.
struct Cut {
    Snapped fit;
    Shares shares;
};

/// All soils take part, not the target alone, so that neighbours get the vertices of its cuts. The
/// water line itself is the first cut.
Cut cut(const std::vector<Soil>& soils, std::size_t target, const LayerRequest& request,
        const std::vector<Vec2>& line, double tolerance) {
    std::vector<Chain> chains;
    for (const Soil& each : soils) chains.push_back({each.ring, true});
    std::vector<double> depths{0.0};
    depths.insert(depths.end(), request.depths.begin(), request.depths.end());
    for (const double depth : depths)
        for (Chain& each : inside_of(soils[target].ring, lowered(line, depth, soils[target].ring)))
            chains.push_back(std::move(each));
    Snapped fit = snapped(chains, tolerance);
    std::set<Edge> edges;
    for (std::size_t c = 0; c < chains.size(); ++c)
        for (const Edge& each : edges_of(fit, c, chains[c].closed)) edges.insert(each);
    Shares shares{fit.nodes, faces_of(fit.nodes, {edges.begin(), edges.end()}), {}};
    return {std::move(fit), std::move(shares)};
}

/// Parts of the target that are nowhere thicker than the tolerance join an adjacent part.
void take_in_thin_parts(Shares& shares, const LayerRequest& request, std::size_t first,
                        double tolerance, const std::vector<Soil>& soils,
                        std::vector<Change>& changes) {
    for (std::size_t part = 0; part <= request.depths.size() + 1; ++part) {
        const int label = static_cast<int>(first + part);
        double width = 0.0;
        Vec2 at = Vec2::Zero();
        for (std::size_t f = 0; f < shares.faces.size(); ++f)
            if (shares.owners[f] == label && shares.faces[f].width > width)
                width = shares.faces[f].width, at = shares.faces[f].inside;
        if (width == 0.0 || width > tolerance) continue;
        // To the part below it; the deepest one has none and joins the part above.
        const int other = part <= request.depths.size() ? label + 1 : label - 1;
        std::ranges::replace(shares.owners, label, other);
        changes.push_back({"sliver", {soils[static_cast<std::size_t>(label)].name}, at, width});
    }
}

/// Faces are assigned anew: those of the target by their depth, all others to their soil.
void cut_region(Healed& healed, std::size_t target, const LayerRequest& request,
                const std::vector<Vec2>& line, double tolerance) {
    const Soil whole = healed.soils[target];
    auto [fit, shares] = cut(healed.soils, target, request, line, tolerance);
    if (!fit.settled) {
        healed.faults.push_back({"layers",
                                 "the layers of " + whole.name + " at " + text(whole.ring.front()) +
                                     " do not fit within " + metres(tolerance),
                                 "give a smaller tolerance, or other depths"});
        return;
    }
    // Labels: the original soils, then the parts.
    std::vector<Soil> soils = healed.soils;
    const std::size_t first = soils.size();
    for (std::size_t part = 0; part <= request.depths.size() + 1; ++part) {
        soils.push_back(whole);
        soils.back().name += part_name(request, part);
        soils.back().depth_layer = static_cast<int>(part);
        soils.back().cut_from = whole.name;
    }
    std::vector<Polygon> rings;
    for (std::size_t s = 0; s < first; ++s)
        rings.push_back(polygon_of(shares.nodes, fit.chains[s]));
    for (const Face& face : shares.faces) {
        int owner = -1;
        for (std::size_t s = 0; s < first && owner < 0; ++s)
            if (geometry::contains(rings[s], face.inside)) owner = static_cast<int>(s);
        if (owner == static_cast<int>(target))
            owner = static_cast<int>(first + part_at(request, line, face.inside));
        shares.owners.push_back(owner);
    }
    take_in_thin_parts(shares, request, first, tolerance, soils, healed.changes);
    give_slivers_away(shares, soils, tolerance, healed.changes);
    std::vector<Soil> result;
    for (std::size_t s = 0; s < soils.size(); ++s) {
        bool holes = false;
        std::vector<Polygon> pieces = pieces_of(shares, static_cast<int>(s), holes);
        for (std::size_t p = 0; p < pieces.size(); ++p) {
            Soil soil = soils[s];
            if (p > 0) soil.name += "_" + std::to_string(p + 1);
            soil.ring = std::move(pieces[p]);
            result.push_back(std::move(soil));
        }
    }
    healed.soils = std::move(result);
}

}  // namespace

/// The last "=" separates, as a layer's name may contain one.
std::optional<LayerRequest> layer_request_from(const std::string& entry,
                                               std::vector<Fault>& faults) {
    const std::size_t split = entry.rfind('=');
    LayerRequest request;
    bool sound = split != std::string::npos && split > 0;
    std::string_view rest = sound ? std::string_view(entry).substr(split + 1) : std::string_view();
    while (sound) {
        const std::size_t end = rest.find(',');
        const auto depth = number_in(rest.substr(0, end));
        sound = depth && *depth > (request.depths.empty() ? 0.0 : request.depths.back()) &&
                *depth < 1e4 && request.depths.size() < 50;
        if (sound) request.depths.push_back(*depth);
        if (end == std::string_view::npos) break;
        rest.remove_prefix(end + 1);
    }
    if (!sound) {
        faults.push_back({"layers",
                          "\"" + as_utf8(entry) + "\" is no region with ascending depths [m]",
                          "write REGION=5,10,15: at most 50 depths above 0"});
        return std::nullopt;
    }
    request.region = as_utf8(entry.substr(0, split));
    return request;
}

/// Names are collected first: cutting adds regions and moves the others.
Healed with_layers(std::vector<Soil> soils, const LayerRequest& request,
                   const std::vector<Vec2>& line, double tolerance) {
    Healed healed{std::move(soils), {}, {}, {}};
    std::set<std::string> meant;
    for (const Soil& each : healed.soils)
        if (lower(each.name) == lower(request.region) || lower(each.layer) == lower(request.region))
            meant.insert(each.name);
    if (meant.empty())
        healed.faults.push_back({"layers", "there is no region \"" + request.region + "\"",
                                 "the regions are " + words::list_of(healed.soils, &Soil::name)});
    for (const std::string& name : meant) {
        const auto at = std::ranges::find(healed.soils, name, &Soil::name);
        cut_region(healed, static_cast<std::size_t>(at - healed.soils.begin()), request, line,
                   tolerance);
    }
    return healed;
}

}  // namespace breach::importing

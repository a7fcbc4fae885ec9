// Removes what drawings have and a mesh cannot: short sides, spikes, slivers between regions,
// gaps and overlaps within the tolerance. Each change is recorded with its place and size and
// shown to the user; larger ones are faults, because only the author knows what was meant.
#include "services/import/heal.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>

#include "core/geometry/polyline.hpp"

namespace breach::importing {

namespace {

// ---------------------------------------------------------------- one outline

/// Width of a spike, narrower than a thousandth of its length; negative: not a spike.
/// Relative to its length: a wide tip is a corner of the section, however small.
double spike_width(const Vec2& before, const Vec2& tip, const Vec2& after) {
    const Vec2 in = before - tip, out = after - tip;
    const double shorter = std::min(in.norm(), out.norm());
    if (in.dot(out) <= 0.0 || shorter == 0.0) return -1.0;
    const double width = in.norm() < out.norm() ? geometry::distance_to_segment(before, tip, after)
                                                : geometry::distance_to_segment(after, tip, before);
    return width <= 1e-3 * shorter ? width : -1.0;
}

/// Drops vertices within the tolerance of the previous one.
/// Compared with the last vertex that was kept: a dense curve is thinned, not eaten up.
void drop_short_sides(Soil& soil, double tolerance, std::vector<Change>& changes) {
    Polygon kept;
    for (const Vec2& each : soil.ring) {
        const double side = kept.empty() ? INFINITY : (each - kept.back()).norm();
        if (side > tolerance) {
            kept.push_back(each);
        } else {
            changes.push_back({"short_side", {soil.name}, kept.back(), side});
        }
    }
    while (kept.size() > 1 && (kept.back() - kept.front()).norm() <= tolerance) {
        changes.push_back(
            {"short_side", {soil.name}, kept.front(), (kept.back() - kept.front()).norm()});
        kept.pop_back();
    }
    soil.ring = std::move(kept);
}

/// Starts again after each: what is left may form a new spike. A triangle stays, thin or not.
void drop_spikes(Soil& soil, double tolerance, std::vector<Change>& changes) {
    Polygon& ring = soil.ring;
    for (std::size_t i = 0; i < ring.size() && ring.size() > 3;) {
        const std::size_t n = ring.size(), before = (i + n - 1) % n, after = (i + 1) % n;
        const double width = spike_width(ring[before], ring[i], ring[after]);
        if (width < 0.0 || width > tolerance) {
            ++i;
            continue;
        }
        changes.push_back({"spike", {soil.name}, ring[i], width});
        const bool same = (ring[before] - ring[after]).norm() <= tolerance;
        ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(i));
        if (same) ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(i % ring.size()));
        i = 0;
    }
}

/// Each outline by itself; it is counter-clockwise afterwards.
void clean(Soil& soil, double tolerance, std::vector<Change>& changes) {
    drop_short_sides(soil, tolerance, changes);
    drop_spikes(soil, tolerance, changes);
    if (soil.ring.size() < 3 || geometry::signed_area(soil.ring) >= 0.0) return;
    std::ranges::reverse(soil.ring);
    changes.push_back({"orientation", {soil.name}, soil.ring.front(), 0.0});
}

std::optional<Vec2> crossing(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
    const auto cross = geometry::crossing(a, b, c, d);
    return cross && cross->is_within() ? std::optional(cross->at) : std::nullopt;
}

/// Mean width of a slender ring [m].
/// Twice the area over the length of the outline: exact for a long strip.
double slimness(const Polygon& ring) {
    double length = 0.0;
    for (std::size_t i = 0; i < ring.size(); ++i)
        length += (ring[(i + 1) % ring.size()] - ring[i]).norm();
    return length > 0.0 ? 2.0 * geometry::area(ring) / length : 0.0;
}

/// Crossings of the outline with itself that cut off more than a sliver. A sliver within the
/// tolerance is no fault.
/// At most 20: a scribble would otherwise fill the report.
std::vector<Vec2> self_crossings(const Polygon& ring, double tolerance) {
    std::vector<Vec2> places;
    const std::size_t n = ring.size();
    for (std::size_t i = 0; i < n && places.size() < 20; ++i) {
        for (std::size_t j = i + 2; j < n && places.size() < 20; ++j) {
            if (i == 0 && j + 1 == n) continue;
            const auto at = crossing(ring[i], ring[i + 1], ring[j], ring[(j + 1) % n]);
            if (!at) continue;
            Polygon loop{*at}, rest{*at};
            for (std::size_t k = i + 1; k <= j; ++k) loop.push_back(ring[k]);
            for (std::size_t k = j + 1; k < i + 1 + n; ++k) rest.push_back(ring[k % n]);
            if (std::min(slimness(loop), slimness(rest)) > tolerance) places.push_back(*at);
        }
    }
    return places;
}

/// Adds the faults of an outline that cannot be used; true: there are some.
bool refused(const Soil& soil, double tolerance, std::vector<Fault>& faults) {
    const std::string who = soil.origin.entity + " on layer " + soil.layer;
    if (soil.ring.size() < 3 || slimness(soil.ring) <= 0.5 * tolerance) {
        if (self_crossings(soil.ring, tolerance).empty()) {
            faults.push_back({at_line(soil.origin.line),
                              who + " at " +
                                  text(soil.ring.empty() ? Vec2::Zero() : soil.ring.front()) +
                                  " encloses no area",
                              "draw the outline of the soil, or remove the entity"});
            return true;
        }
    }
    const std::vector<Vec2> places = self_crossings(soil.ring, tolerance);
    for (const Vec2& each : places)
        faults.push_back({at_line(soil.origin.line), who + " crosses itself at " + text(each),
                          "move the vertices there, so that no two sides cross"});
    return !places.empty();
}

// ---------------------------------------------------------------- several

/// Moves vertices near the section's ends onto the vertical end lines: slices and walls would
/// otherwise find air between corners that are not exactly above each other.
void straighten_ends(std::vector<Soil>& soils, double tolerance, std::vector<Change>& changes) {
    double left = INFINITY, right = -INFINITY;
    for (const Soil& soil : soils)
        for (const Vec2& each : soil.ring) {
            left = std::min(left, each.x());
            right = std::max(right, each.x());
        }
    for (Soil& soil : soils)
        for (Vec2& each : soil.ring)
            for (const double end : {left, right}) {
                const double off = std::abs(each.x() - end);
                if (off == 0.0 || off > tolerance) continue;
                each.x() = end;
                changes.push_back({"end", {soil.name}, each, off});
            }
}

/// Strictly: a place on the border is shared, not overlapped.
bool is_within(const Polygon& ring, const Vec2& place) {
    if (!geometry::contains(ring, place)) return false;
    for (std::size_t i = 0; i < ring.size(); ++i)
        if (geometry::distance_to_segment(place, ring[i], ring[(i + 1) % ring.size()]) < 1e-9)
            return false;
    return true;
}

/// Several edges may meet one node; each pair of outlines is listed once per place. A vertex that
/// fits exactly is no change.
void tell_meetings(const Snapped& snapped, const std::vector<Soil>& soils,
                   std::vector<Change>& changes) {
    const auto name = [&](std::size_t chain) {
        return chain < soils.size() ? soils[chain].name : "terrain";
    };
    std::set<std::tuple<std::size_t, std::size_t, double, double>> told;
    for (const Meeting& each : snapped.meetings) {
        if (!told.insert({each.chain, each.with, each.at.x(), each.at.y()}).second) continue;
        const double size = (each.at - each.was).norm();
        const double extent = each.at.cwiseAbs().maxCoeff() + 1.0;
        const bool lines = each.chain >= soils.size() || each.with >= soils.size();
        std::string kind = "junction";
        if (size > 1e-12 * extent) {
            // Overlap: the vertex was inside the other soil, or the edge's soil covered the vertex.
            const bool over = !lines && (each.on_edge ? is_within(soils[each.chain].ring, each.at)
                                                      : is_within(soils[each.with].ring, each.was));
            kind = over ? "overlap" : "gap";
        } else if (!each.on_edge || lines) {
            continue;
        }
        changes.push_back({kind, {name(each.chain), name(each.with)}, each.at, size});
    }
}

/// Nodes along the terrain's chain, without those that snapping moved backwards.
/// A terrain has one level at every x, which two merged nodes can violate.
std::vector<Vec2> terrain_of(const Snapped& snapped, std::size_t chain) {
    std::vector<Vec2> line;
    for (const std::size_t node : snapped.chains[chain])
        if (line.empty() || snapped.nodes[node].x() > line.back().x())
            line.push_back(snapped.nodes[node]);
    return line;
}

std::string list_of(const std::vector<int>& owners, const std::vector<Soil>& soils) {
    std::string list;
    for (const int each : owners)
        list += (list.empty() ? "" : " and ") + soils[static_cast<std::size_t>(each)].name;
    return list;
}

/// One face at an edge: outside lies no soil.
std::map<Edge, std::vector<std::size_t>> faces_at_edges(const std::vector<Face>& faces) {
    std::map<Edge, std::vector<std::size_t>> at;
    for (std::size_t f = 0; f < faces.size(); ++f)
        for (std::size_t i = 0; i < faces[f].ring.size(); ++i)
            at[edge_of(faces[f].ring[i], faces[f].ring[(i + 1) % faces[f].ring.size()])].push_back(
                f);
    return at;
}

/// Border lengths of these faces with each adjacent owner [m].
std::map<int, double> borders(const Shares& shares, const std::set<std::size_t>& of) {
    std::map<int, double> lengths;
    for (const auto& [edge, faces] : faces_at_edges(shares.faces)) {
        if (faces.size() != 2) continue;
        for (const int k : {0, 1}) {
            const std::size_t here = faces[k], there = faces[1 - k];
            if (!of.contains(here) || of.contains(there) || shares.owners[there] < 0) continue;
            lengths[shares.owners[there]] +=
                (shares.nodes[edge.first] - shares.nodes[edge.second]).norm();
        }
    }
    return lengths;
}

/// Among all owners if `among` is empty; -1: no border.
/// The longest border, not the larger soil: the change of both outlines is then smallest.
int longest_of(const std::map<int, double>& lengths, const std::vector<int>& among) {
    int best = -1;
    double most = 0.0;
    for (const auto& [owner, length] : lengths) {
        if (!among.empty() && std::ranges::find(among, owner) == among.end()) continue;
        if (length > most) most = length, best = owner;
    }
    return best;
}

/// A face that no outline or several claim.
struct Claim {
    std::size_t face;
    std::vector<int> owners;
};

/// Gives each face to its soil, or a thin one to a neighbour; thick others are faults.
Shares shared_out(const Snapped& snapped, const std::vector<Soil>& soils, double tolerance,
                  Healed& result) {
    std::set<Edge> edges;
    std::vector<Polygon> rings;
    for (std::size_t c = 0; c < soils.size(); ++c) {
        for (const Edge& each : edges_of(snapped, c, true)) edges.insert(each);
        rings.push_back(polygon_of(snapped.nodes, snapped.chains[c]));
    }
    Shares shares{snapped.nodes, faces_of(snapped.nodes, {edges.begin(), edges.end()}), {}};
    std::vector<Claim> open;
    for (std::size_t f = 0; f < shares.faces.size(); ++f) {
        Claim claim{f, {}};
        for (std::size_t c = 0; c < soils.size(); ++c)
            if (rings[c].size() >= 3 && geometry::contains(rings[c], shares.faces[f].inside))
                claim.owners.push_back(static_cast<int>(c));
        shares.owners.push_back(claim.owners.size() == 1 ? claim.owners.front() : -1);
        if (claim.owners.size() != 1) open.push_back(std::move(claim));
    }
    for (const Claim& each : open) {
        const Face& face = shares.faces[each.face];
        const bool gap = each.owners.empty();
        const auto lengths = borders(shares, {each.face});
        std::vector<int> names = each.owners;
        if (gap)
            for (const auto& [owner, length] : lengths) names.push_back(owner);
        if (face.width <= tolerance) {
            int winner = longest_of(lengths, each.owners);
            if (winner < 0 && !gap) winner = each.owners.front();
            shares.owners[each.face] = winner;
            Change change{gap ? "gap" : "overlap", {}, face.inside, face.width};
            for (const int n : names)
                change.regions.push_back(soils[static_cast<std::size_t>(n)].name);
            result.changes.push_back(std::move(change));
            continue;
        }
        const Origin& origin =
            soils[static_cast<std::size_t>(names.empty() ? 0 : names.back())].origin;
        const std::string size = " at " + text(face.inside) + ", " + metres(face.width) +
                                 " wide, " + square_metres(face.area);
        result.faults.push_back(
            {at_line(origin.line),
             gap ? "a gap between " + list_of(names, soils) + size
                 : list_of(names, soils) + " overlap" + size,
             (gap ? "draw the soil that lies there, or let its neighbours share their border"
                  : "let one of them end at the other") +
                 std::string(face.width <= 4.0 * tolerance
                                 ? "; a tolerance of " + metres(1.1 * face.width) + " heals it"
                                 : "")});
    }
    return shares;
}

/// Faces of one soil connected by edges.
std::vector<std::vector<std::size_t>> groups_of(const Shares& shares, int owner) {
    std::vector<std::size_t> parent(shares.faces.size());
    std::iota(parent.begin(), parent.end(), std::size_t{0});
    const auto root = [&](std::size_t f) {
        while (parent[f] != f) f = parent[f] = parent[parent[f]];
        return f;
    };
    for (const auto& [edge, faces] : faces_at_edges(shares.faces))
        if (faces.size() == 2 && shares.owners[faces[0]] == owner &&
            shares.owners[faces[1]] == owner)
            parent[root(faces[0])] = root(faces[1]);
    std::map<std::size_t, std::vector<std::size_t>> groups;
    for (std::size_t f = 0; f < shares.faces.size(); ++f)
        if (shares.owners[f] == owner) groups[root(f)].push_back(f);
    std::vector<std::vector<std::size_t>> sorted;
    for (auto& [first, group] : groups) sorted.push_back(std::move(group));
    const auto area = [&](const std::vector<std::size_t>& group) {
        double sum = 0.0;
        for (const std::size_t f : group) sum += shares.faces[f].area;
        return sum;
    };
    std::ranges::stable_sort(sorted, std::greater<>(), area);
    return sorted;
}

}  // namespace

void give_slivers_away(Shares& shares, const std::vector<Soil>& soils, double tolerance,
                       std::vector<Change>& changes) {
    for (std::size_t s = 0; s < soils.size(); ++s) {
        const auto groups = groups_of(shares, static_cast<int>(s));
        for (std::size_t g = 1; g < groups.size(); ++g) {
            const auto width = [&](std::size_t f) { return shares.faces[f].width; };
            const std::size_t widest = *std::ranges::max_element(groups[g], {}, width);
            if (width(widest) > tolerance) continue;
            const int winner =
                longest_of(borders(shares, {groups[g].begin(), groups[g].end()}), {});
            for (const std::size_t f : groups[g]) shares.owners[f] = winner;
            Change change{"sliver", {soils[s].name}, shares.faces[widest].inside, width(widest)};
            if (winner >= 0) change.regions.push_back(soils[static_cast<std::size_t>(winner)].name);
            changes.push_back(std::move(change));
        }
    }
}

std::vector<Polygon> pieces_of(const Shares& shares, int owner, bool& holes) {
    std::vector<const Face*> faces;
    for (std::size_t f = 0; f < shares.faces.size(); ++f)
        if (shares.owners[f] == owner) faces.push_back(&shares.faces[f]);
    std::vector<Polygon> pieces;
    holes = false;
    for (const auto& ring : union_of(shares.nodes, faces)) {
        Polygon polygon = polygon_of(shares.nodes, ring);
        if (geometry::signed_area(polygon) > 0.0) {
            pieces.push_back(std::move(polygon));
        } else {
            holes = true;
        }
    }
    std::ranges::stable_sort(pieces, std::greater<>(), geometry::area);
    return pieces;
}

/// Faults that follow from earlier ones are left out (`blamed`): an overlap alone would also
/// report regions in pieces.
Healed healed(std::vector<Soil> soils, double tolerance, const std::vector<Vec2>& terrain) {
    Healed result;
    std::vector<Soil> sound;
    for (Soil& each : soils) {
        clean(each, tolerance, result.changes);
        if (!refused(each, tolerance, result.faults)) sound.push_back(std::move(each));
    }
    straighten_ends(sound, tolerance, result.changes);
    std::vector<Chain> chains;
    for (const Soil& each : sound) chains.push_back({each.ring, true});
    if (!terrain.empty()) chains.push_back({terrain, false});
    const Snapped fit = snapped(chains, tolerance);
    if (!fit.settled) {
        result.faults.push_back({"tolerance",
                                 "the outlines cannot be joined within " + metres(tolerance) +
                                     ": too many lines cross or nearly touch",
                                 "give a smaller tolerance, or draw each border once and copy it"});
        return result;
    }
    tell_meetings(fit, sound, result.changes);
    if (!terrain.empty()) result.terrain = terrain_of(fit, sound.size());
    Shares shares = shared_out(fit, sound, tolerance, result);
    give_slivers_away(shares, sound, tolerance, result.changes);
    for (std::size_t s = 0; s < sound.size(); ++s) {
        Soil& soil = sound[s];
        bool holes = false;
        std::vector<Polygon> pieces = pieces_of(shares, static_cast<int>(s), holes);
        const bool blamed = !result.faults.empty();
        if (pieces.empty()) {
            if (!blamed)
                result.faults.push_back(
                    {at_line(soil.origin.line),
                     soil.name + " at " + text(soil.ring.front()) +
                         " is thinner than the tolerance: nothing of it is left",
                     "give a smaller tolerance, or leave the region out"});
            continue;
        }
        if (holes && !blamed) {
            result.faults.push_back({at_line(soil.origin.line),
                                     soil.name + " at " + text(soil.ring.front()) +
                                         " encloses another region: a region has one outline",
                                     "cut it in two by a line through what it encloses"});
        } else if (pieces.size() > 1 && !blamed) {
            result.faults.push_back(
                {at_line(soil.origin.line),
                 soil.name + " touches itself: a part of it is connected only at the point " +
                     text(pieces[1].front()),
                 "draw its parts as outlines of their own, or join them by more than a point"});
        }
        soil.ring = std::move(pieces.front());
        result.soils.push_back(std::move(soil));
    }
    return result;
}

}  // namespace breach::importing

// Colours for materials. They differ in lightness, so that they can be distinguished in
// black-and-white print and with colour blindness. Independent of scenes: a material's colour is
// its place in the order in which regions name them.
#pragma once

#include <array>
#include <cstddef>

namespace breach::drawing {

/// A fill as "#rrggbb", and whether text on it is white.
struct Fill {
    const char* colour;
    bool dark;
};

/// Any two differ by at least 5 of CIE L* (from 93 to 29), and by at least 0.05 in OKLab for
/// trichromats, protanopes and deuteranopes (Machado et al. 2009); neighbours in the list by far
/// more.
inline constexpr std::array<Fill, 12> fills{{{"#ae8543", false},
                                             {"#b3d3ad", false},
                                             {"#3f618f", true},
                                             {"#bd9087", false},
                                             {"#def2bf", false},
                                             {"#5f753e", true},
                                             {"#a4a4ed", false},
                                             {"#38879a", false},
                                             {"#9ac77d", false},
                                             {"#6f303c", true},
                                             {"#71ebff", false},
                                             {"#41536e", true}}};

/// Fill of the n-th material; after the twelfth they repeat, and hatchings_of distinguishes them.
inline const Fill& fill_of(std::size_t material) { return fills[material % fills.size()]; }
/// Number of sets of hatching lines: none, one direction, two directions.
inline std::size_t hatchings_of(std::size_t material) { return material / fills.size() % 3; }

}  // namespace breach::drawing

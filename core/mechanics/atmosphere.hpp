// The standard atmosphere, a unit of published strength relations.
#pragma once

namespace breach::mechanics {

inline constexpr double standard_atmosphere = 101.325e3;  ///< [Pa]

}  // namespace breach::mechanics

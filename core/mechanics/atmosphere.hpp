// The standard atmosphere, which published strength relations are written in.
#pragma once

namespace breach::mechanics {

inline constexpr double standard_atmosphere = 101.325e3;  ///< [Pa]

}  // namespace breach::mechanics

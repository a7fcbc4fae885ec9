// How many points the batch of a law takes side by side.
#pragma once

namespace breach::materials {

/// Widest first. A width that this CPU lacks is replaced by the next one.
enum class Width { widest, avx512, avx2, portable };

}  // namespace breach::materials

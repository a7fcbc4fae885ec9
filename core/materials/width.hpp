// Number of points that a batch integrates side by side.
#pragma once

namespace breach::materials {

/// Vector instruction set; one that the CPU lacks is replaced by the next.
enum class Width { widest, avx512, avx2, portable };

}  // namespace breach::materials

// The semantic version. What a major version promises: CHANGELOG.md, tests/packaging/promises.py.
#pragma once

namespace breach {

/// "1.0.0+1a2b3c4"; without the commit if the program was not built from a checkout.
const char* version();

}  // namespace breach

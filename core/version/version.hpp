// Which Breachline this is, as a semantic version. CHANGELOG.md says what a major version keeps, and
// tests/packaging/promises.py checks it. Kept apart so that a new commit compiles one file and no more.
#pragma once

namespace breach {

/// "1.0.0+1a2b3c4"; without the commit where the program was not built from a checkout.
const char* version();

}  // namespace breach

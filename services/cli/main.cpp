// The program `breach`; everything else is in the library, which tests link.
#include "services/cli/command_line.hpp"

int main(int argc, char** argv) { return breach::cli::run(argc, argv); }

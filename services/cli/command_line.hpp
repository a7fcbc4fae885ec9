// The command line of `breach`: parses it, runs the command, and turns exceptions into messages and
// exit codes.
//
//      0  done
//      2  usage
//     65  refused, by the server or because the study is not JSON
//     70  the run failed
//     74  a file cannot be read or written, or is invalid
//     75  the server does not answer
#pragma once

namespace breach::cli {

int run(int argc, char** argv);

}  // namespace breach::cli

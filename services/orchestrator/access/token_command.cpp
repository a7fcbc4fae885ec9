// `breachline token`: changes the file, which a running service reads within a second. It needs
// no service, because the first token is made before there is one.
#include "services/orchestrator/access/token_command.hpp"

#include <iostream>

#include "services/orchestrator/access/tokens.hpp"

namespace breach::orchestrator {

CLI::App* TokenCommand::add_to(CLI::App& program) {
    CLI::App* command = program.add_subcommand("token", "named tokens of serve --tokens FILE");
    command->require_subcommand(1);
    command->fallthrough();
    command->add_option("--file", file_, "the file of tokens")->capture_default_str();
    make_ = command->add_subcommand("new",
                                    "make a token and print its secret, once; example: breachline "
                                    "token new anna --rights submit");
    make_->add_option("name", name_, "whose it is: events say it")->required();
    make_
        ->add_option("--rights", rights_,
                     "read; submit (read, compute, change runs); admin (submit, remove)")
        ->required();
    remove_ = command->add_subcommand("rm", "take a token's rights away, within a second");
    remove_->add_option("name", name_, "whose it is")->required();
    command->add_subcommand("list", "names and rights");
    return command;
}

int TokenCommand::run() const {
    if (*make_) {
        const std::string secret = add_token(file_, name_, right_named(rights_));
        // The secret alone on stdout, so that a script can write it into a file.
        std::cout << secret << "\n";
        std::cerr
            << "kept nowhere else: hand it over now; a client reads it from the file named by "
               "--token-file or BREACH_TOKEN_FILE\n";
    } else if (*remove_) {
        remove_token(file_, name_);
    } else {
        for (const Token& each : read_tokens(file_))
            std::cout << each.name << "  " << name_of(each.right) << "\n";
    }
    return 0;
}

}  // namespace breach::orchestrator

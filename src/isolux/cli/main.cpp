#include <csignal>
#include <string>
#include <vector>

#include "isolux/cli/command_line.h"

int main(int argc, char** argv) {
    // A reader that leaves early (`isolux ... | head`) ends the output, not the program.
    std::signal(SIGPIPE, SIG_IGN);
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    return static_cast<int>(isolux::run_command_line(arguments));
}

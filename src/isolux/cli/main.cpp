#include <csignal>
#include <string>
#include <vector>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "isolux/cli/command_line.h"

int main(int argc, char** argv) {
    // A reader that leaves early (`isolux ... | head`) ends the output, not the program.
    std::signal(SIGPIPE, SIG_IGN);
#ifdef __GLIBC__
    // Pictures allocate planes of megabytes again and again: keep the memory rather than have
    // it cleared anew each time.
    mallopt(M_MMAP_THRESHOLD, 32 << 20);
    mallopt(M_TRIM_THRESHOLD, 512 << 20);
#endif
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    return static_cast<int>(isolux::run_command_line(arguments));
}

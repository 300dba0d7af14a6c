#include "isolux/viz/display.h"

#include <cstdlib>

#include <dlfcn.h>

namespace isolux {

namespace {

struct XDisplay; // Xlib's, never looked into

/// The three functions of Xlib that it takes to ask.
struct Xlib {
    XDisplay* (*open)(const char*) = nullptr;
    int (*close)(XDisplay*) = nullptr;
    int (*query_extension)(XDisplay*, const char*, int*, int*, int*) = nullptr;

    [[nodiscard]] bool is_complete() const noexcept { return open && close && query_extension; }
};

Xlib load_xlib() {
    Xlib x;
    // VTK's windows have it loaded already; it stays loaded.
    if (void* library = dlopen("libX11.so.6", RTLD_NOW | RTLD_GLOBAL)) {
        x.open = reinterpret_cast<decltype(x.open)>(dlsym(library, "XOpenDisplay"));
        x.close = reinterpret_cast<decltype(x.close)>(dlsym(library, "XCloseDisplay"));
        x.query_extension =
            reinterpret_cast<decltype(x.query_extension)>(dlsym(library, "XQueryExtension"));
    }
    return x;
}

} // namespace

std::optional<std::string> find_display_problem() {
    const char* name = std::getenv("DISPLAY");
    if (name == nullptr || *name == '\0')
        return "DISPLAY is not set";
    const Xlib x = load_xlib();
    if (!x.is_complete())
        return "libX11 is not installed";
    XDisplay* display = x.open(name);
    if (display == nullptr)
        return "DISPLAY is " + std::string(name) + ", where no X server answers";
    int opcode = 0, event = 0, error = 0;
    const bool has_opengl = x.query_extension(display, "GLX", &opcode, &event, &error) != 0;
    x.close(display);
    if (!has_opengl)
        return "the X server at " + std::string(name) + " has no OpenGL";
    return std::nullopt;
}

} // namespace isolux

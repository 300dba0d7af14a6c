#pragma once

#include <string>
#include <vector>

/// Runs the built `isolux` as a user's shell would.
namespace isolux::test {

struct Ran {
    int exit_code = -1; ///< 128 + signal if a signal ended it
    std::string out;
    std::string err;
};

/// @param input  what it reads on standard input
[[nodiscard]] Ran run_program(const std::vector<std::string>& arguments,
                              const std::string& input = {});

/// The same through `sh -c`; `$ISOLUX` is the program.
[[nodiscard]] Ran run_shell(const std::string& script);

/// A fresh folder that is removed with the object.
class TemporaryFolder {
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    [[nodiscard]] std::string path(const std::string& name = {}) const;
    /// Writes a file into it and returns its path.
    [[nodiscard]] std::string write(const std::string& name, const std::string& text) const;

private:
    std::string path_;
};

[[nodiscard]] std::string read_text(const std::string& path);

} // namespace isolux::test

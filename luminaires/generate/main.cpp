// Writes every sample luminaire as .ies and .ldt into a folder, or (--check) tells whether the
// files there are what would be written.
//
//     isolux_make_luminaires [--check] FOLDER

#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>

#include "isolux/photometry/write_ies.h"
#include "isolux/photometry/write_ldt.h"

#include "catalogue.h"

namespace {

namespace fs = std::filesystem;

std::string ies_text(const Sample& sample) {
    isolux::IesWriteOptions options;
    options.test = "calculated from a formula, not measured";
    options.laboratory = "isolux, luminaires/generate";
    options.issue_date = "22-NOV-2026";
    options.generation_type = 1.0001; // computer simulation
    return isolux::write_ies(sample.luminaire, options).value;
}

std::string ldt_text(const Sample& sample) {
    isolux::LdtWriteOptions options;
    options.report = "calculated from a formula, not measured";
    options.file_name = sample.file;
    options.date_and_user = "2026-11-22/isolux";
    return isolux::write_ldt(sample.luminaire, options).value;
}

std::string read(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// True if the file holds `text` afterwards, or did before when only checking.
bool settle(const fs::path& path, const std::string& text, bool only_check) {
    if (only_check) {
        const bool is_same = read(path) == text;
        if (!is_same)
            std::cerr << path.string() << ": not what isolux_make_luminaires writes\n";
        return is_same;
    }
    std::ofstream stream(path, std::ios::binary);
    stream << text;
    return stream.good();
}

} // namespace

int main(int argc, char** argv) {
    const bool only_check = argc == 3 && std::string(argv[1]) == "--check";
    if (argc != 2 && !only_check) {
        std::cerr << "isolux_make_luminaires [--check] FOLDER\n";
        return 2;
    }
    const fs::path folder = argv[argc - 1];
    bool all_well = true;
    for (const Sample& sample : make_catalogue()) {
        all_well &= settle(folder / (sample.file + ".ies"), ies_text(sample), only_check);
        all_well &= settle(folder / (sample.file + ".ldt"), ldt_text(sample), only_check);
    }
    return all_well ? 0 : 1;
}

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "isolux/base/error.h"
#include "isolux/cli/experiments.h"

namespace isolux {

namespace {

struct Experiment {
    const char* name;
    Action (*add)(CLI::App&);
};

constexpr std::array experiments{
    Experiment{"sobolev", add_sobolev_experiment},
    Experiment{"denoise", add_denoise_experiment},
    Experiment{"soft-shadow", add_soft_shadow_experiment},
    Experiment{"indirect", add_indirect_experiment},
    Experiment{"lens", add_lens_experiment},
};

} // namespace

Action add_experiment(CLI::App& verb) {
    verb.description("Measure what a method can do, with tables and plots");
    verb.formatter(std::make_shared<CLI::Formatter>()); // the program's own says VERB
    verb.get_formatter()->label("SUBCOMMAND", "EXPERIMENT");
    std::vector<std::pair<CLI::App*, Action>> actions;
    std::vector<std::string> names;
    for (const Experiment& experiment : experiments) {
        CLI::App* const sub = verb.add_subcommand(experiment.name)->group("Experiments");
        actions.emplace_back(sub, experiment.add(*sub));
        names.emplace_back(experiment.name);
    }
    verb.require_subcommand(0, 1);
    verb.footer(R"(
Examples:
  isolux experiment sobolev               every method on one problem with a closed answer
  isolux experiment denoise               noisy and denoised pictures beside a converged one
  isolux experiment indirect              what the filter is worth, in samples and seconds
  isolux experiment sobolev --help        options and examples of an experiment)");
    return [actions, names] {
        for (const auto& [sub, action] : actions)
            if (sub->parsed())
                return action();
        throw InputError(
            "isolux experiment",
            "no experiment is named",
            fmt::format("Known are {}: `isolux experiment --help`", fmt::join(names, ", ")));
    };
}

} // namespace isolux

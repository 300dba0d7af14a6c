#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "isolux/base/estimate.h"
#include "isolux/calc/calculate.h"

/// Closed-form cases against the engine, on the user's own machine.
namespace isolux {

/// One number of a calculation whose value is known.
struct KnownAnswer {
    std::string quantity; ///< where and what, for people
    std::string unit;
    double reference = 0.0;
    /// Takes the engine's answer out of the results.
    std::function<Estimate(const Results&)> computed;
    /// How far the case itself may be from the reference, relative: 0 where it is exact.
    double allowance = 0.0;
};

/// A small scene with known answers.
struct SelftestCase {
    std::string name;
    std::function<SceneDescription()> scene;
    std::vector<CalculationSurface> surfaces;
    Settings settings;
    std::vector<KnownAnswer> answers;
};

/// Sobolev's problem, integrating sphere, furnace, cube of CIE 171:2006 test 5.8, shoebox,
/// inverse square and cosine law, Lambertian shapes, a tabulated luminaire; flux balance with
/// each closed room.
[[nodiscard]] std::vector<SelftestCase> make_selftest_cases();

/// The same by kind, for those who want only some of them.
[[nodiscard]] std::vector<SelftestCase> make_direct_cases();
[[nodiscard]] std::vector<SelftestCase> make_sobolev_cases();
[[nodiscard]] std::vector<SelftestCase> make_enclosure_cases();

struct SelftestRow {
    std::string name; ///< of the case
    std::string quantity;
    std::string unit;
    Estimate computed;
    double reference = 0.0;
    double z = 0.0;       ///< deviation beyond the allowance / standard error; 0 if that is 0
    double z_limit = 0.0; ///< 0: deterministic, compared to deterministic_tolerance
    bool passed = false;
};

/// What every row is held to.
struct SelftestCriteria {
    double false_alarm = 1e-6; ///< of a whole run, shared by its statistical rows (Bonferroni)
    double deterministic_tolerance = 1e-6; ///< relative, where there is no standard error
    double largest_error = 0.005; ///< standard error / reference: a blunter row shows nothing
};

/// Judges one answer. @param rows  number of rows in the run, for Bonferroni
[[nodiscard]] SelftestRow judge(const SelftestCase& selftest,
                                const KnownAnswer& answer,
                                const Estimate& computed,
                                std::size_t rows,
                                const SelftestCriteria& criteria = {});

/// Calculates a case with a seed of its own.
[[nodiscard]] Results
calculate(const SelftestCase& selftest, std::uint64_t seed, const Control& control = {});

} // namespace isolux

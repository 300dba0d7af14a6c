#include "isolux/calc/selftest.h"

#include <algorithm>
#include <cmath>

namespace isolux {

SelftestRow judge(const SelftestCase& selftest,
                  const KnownAnswer& answer,
                  const Estimate& computed,
                  std::size_t rows,
                  const SelftestCriteria& criteria) {
    SelftestRow row{selftest.name,
                    answer.quantity,
                    answer.unit,
                    computed,
                    answer.reference,
                    0.0,
                    0.0,
                    false};
    const double scale = std::abs(answer.reference);
    const double off = computed.mean - answer.reference;
    const double deviation =
        std::copysign(std::max(0.0, std::abs(off) - answer.allowance * scale), off);
    // A standard error of nothing but rounding is none.
    const bool is_statistical =
        computed.samples > 1 && computed.standard_error > 1e-9 * std::abs(computed.mean);
    if (!is_statistical) {
        row.passed = std::abs(deviation) <= criteria.deterministic_tolerance * scale;
        return row;
    }
    row.z = deviation / computed.standard_error;
    row.z_limit = student_quantile(1.0 - criteria.false_alarm / static_cast<double>(rows),
                                   static_cast<double>(computed.samples - 1));
    row.passed = std::abs(row.z) <= row.z_limit
                 && computed.standard_error <= criteria.largest_error * scale;
    return row;
}

Results calculate(const SelftestCase& selftest, std::uint64_t seed, const Control& control) {
    const Scene scene = build_scene(selftest.scene());
    Settings settings = selftest.settings;
    settings.seed = seed;
    return calculate(scene, selftest.surfaces, settings, control);
}

} // namespace isolux

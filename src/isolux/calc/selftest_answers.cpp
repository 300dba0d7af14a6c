#include "isolux/calc/selftest_answers.h"

#include <utility>

namespace isolux {

Settings selftest_settings() {
    Settings settings;
    // At the first check half a width is 4.3 standard errors, later it is more: none is above
    // 0.47 % of its value.
    settings.tolerance = 0.02;
    settings.confidence = 0.999;
    settings.absolute_tolerance = 0.0;
    return settings;
}

CalculationSurface make_point_surface(std::string name, const Receiver& receiver) {
    CalculationSurface surface;
    surface.name = std::move(name);
    surface.kind = receiver.kind;
    surface.receivers = {receiver};
    return surface;
}

void add_point(SelftestCase& selftest,
               std::string name,
               const Receiver& receiver,
               Part part,
               Lux reference,
               double allowance) {
    const std::size_t index = selftest.surfaces.size();
    selftest.surfaces.push_back(make_point_surface(name, receiver));
    selftest.answers.push_back({std::move(name),
                                "lx",
                                in_lux(reference),
                                [index, part](const Results& results) {
                                    const PointResult& p = results.surfaces[index].points[0];
                                    return part == Part::total    ? p.total
                                           : part == Part::direct ? p.direct
                                                                  : p.indirect;
                                },
                                allowance});
}

void add_flux_balance(SelftestCase& selftest, Lumen emitted) {
    selftest.answers.push_back(
        {"flux absorbed", "lm", in_lumen(emitted), [](const Results& results) {
             return results.flux_balance.absorbed;
         }});
}

std::vector<SelftestCase> make_selftest_cases() {
    std::vector<SelftestCase> all = make_direct_cases();
    for (auto* make : {make_sobolev_cases, make_enclosure_cases}) {
        for (SelftestCase& selftest : make())
            all.push_back(std::move(selftest));
    }
    return all;
}

} // namespace isolux

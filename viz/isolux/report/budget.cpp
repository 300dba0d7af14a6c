#include "isolux/report/budget.h"

#include <cmath>

namespace isolux::report {

double Budget::share(double component) const noexcept {
    return combined > 0.0 ? component * component / (combined * combined) : 0.0;
}

Budget make_budget(const SurfaceResult& s, double confidence, const Assumptions& assumptions) {
    Budget b;
    const double mean = s.summary.mean.mean;
    if (!(mean > 0.0))
        return b;
    const Interval interval = confidence_interval(s.summary.mean, confidence);
    b.monte_carlo = 0.5 * (interval.upper - interval.lower) / mean;
    double all = 0.0;
    double reflected = 0.0;
    for (const PointResult& p : s.points) {
        all += p.total.mean;
        reflected += p.indirect.mean;
    }
    b.photometry = assumptions.photometry;
    b.flux = assumptions.flux;
    b.reflectance = all > 0.0 ? assumptions.reflected_light * reflected / all : 0.0;
    b.maintenance = assumptions.maintenance;
    // METHODS eq. (121)
    b.combined =
        std::sqrt(b.monte_carlo * b.monte_carlo + b.photometry * b.photometry + b.flux * b.flux
                  + b.reflectance * b.reflectance + b.maintenance * b.maintenance);
    return b;
}

} // namespace isolux::report

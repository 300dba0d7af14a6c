#pragma once

/// Balance-heuristic weights of all techniques that could have made a path, carried along a
/// subpath as two partial sums: METHODS "Bidirectional path tracing", eq. (78) to (80). Source:
/// Georgiev, "Implementing vertex connection and merging", 2012; van Antwerpen, "Recursive MIS
/// computation for streaming BDPT on the GPU", 2011. Densities include roulette and the choice
/// of a lobe.
namespace isolux {

struct PartialWeights {
    double vcm = 0.0;
    double vc = 0.0;

    /// The subpath met a surface after `distance` m. @param cosine  of incidence, above 0
    constexpr void arrive(double distance, double cosine) noexcept {
        vcm *= distance * distance / cosine;
        vc /= cosine;
    }

    /// It goes on diffusely. @param cosine   of departure
    /// @param pdf      density of the direction taken, 1/sr
    /// @param reverse  of the way back: from where it goes to where it came from, 1/sr
    constexpr void scatter(double cosine, double pdf, double reverse) noexcept {
        vc = cosine / pdf * (vc * reverse + vcm);
        vcm = 1.0 / pdf;
    }

    /// It goes on as from a mirror. @param cosine  of departure
    constexpr void mirror(double cosine) noexcept {
        vcm = 0.0;
        vc *= cosine;
    }

    /// Partial sum towards the end the subpath came from. @param reverse  as in scatter()
    [[nodiscard]] constexpr double towards(double reverse) const noexcept {
        return vcm + vc * reverse;
    }
};

/// Start of a light subpath. @param direct  density of finding its first point from the place
/// it lights: 1/m2, for a point source a probability
/// @param emit    density of place and direction of the emission
/// @param cosine  at the opening; 0 for a point source, which no path can meet
[[nodiscard]] constexpr PartialWeights
start_light_subpath(double direct, double emit, double cosine) noexcept {
    return {direct / emit, cosine / emit};
}

/// Start of a sensor subpath. @param light_paths  light paths connected to the receiver itself
/// for each one connected to the other vertices
[[nodiscard]] constexpr PartialWeights start_sensor_subpath(double light_paths,
                                                            double pdf) noexcept {
    return {light_paths / pdf, 0.0};
}

/// Weight of a sensor path that met an opening. @param at  after arrive() there
[[nodiscard]] constexpr double
weight_of_met_opening(const PartialWeights& at, double direct, double emit) noexcept {
    return 1.0 / (1.0 + direct * at.vcm + emit * at.vc);
}

/// Weight of next-event estimation from a sensor vertex y.
/// @param found    density with which a path scattered at y would have met the same opening
///                 point, over the density of drawing it: 0 for a point source
/// @param emitted  area density at y of a light path from there, over the density of drawing it
/// @param reverse  density at y of the direction back along the sensor subpath
[[nodiscard]] constexpr double weight_of_next_event(double found,
                                                    double emitted,
                                                    const PartialWeights& y,
                                                    double reverse) noexcept {
    return 1.0 / (found + 1.0 + emitted * y.towards(reverse));
}

/// Weight of a connection between light vertex z and sensor vertex y. Densities per area.
[[nodiscard]] constexpr double weight_of_connection(double y_to_z,
                                                    const PartialWeights& z,
                                                    double reverse_z,
                                                    double z_to_y,
                                                    const PartialWeights& y,
                                                    double reverse_y) noexcept {
    return 1.0 / (y_to_z * z.towards(reverse_z) + 1.0 + z_to_y * y.towards(reverse_y));
}

/// Weight of light vertex z seen by the receiver itself. @param gather  density per area at z
/// of a ray from the receiver
[[nodiscard]] constexpr double weight_at_receiver(double gather,
                                                  double light_paths,
                                                  const PartialWeights& z,
                                                  double reverse_z) noexcept {
    return 1.0 / (gather / light_paths * z.towards(reverse_z) + 1.0);
}

} // namespace isolux

#include "isolux/transport/response.h"

#include "isolux/sampling/warp.h"

namespace isolux {

UnitVector3 sample_response(const Receiver& receiver, double u, double v) noexcept {
    if (!is_planar(receiver))
        return sample_sphere(u, v);
    const Vector3 local = sample_cosine_hemisphere(u, v);
    return UnitVector3::from_unit(make_basis(receiver.axis).to_world(local));
}

} // namespace isolux

// An orthonormal frame around a unit normal: local z is the normal.
#pragma once

#include "core/kernel/base/numbers.h"

namespace pl {

template <class N>
struct FrameOf {
    Real3<N> x, y, z;

    PL_INLINE Real3<N> to_world(const Real3<N>& local) const {
        return {local.x * x.x + local.y * y.x + local.z * z.x, local.x * x.y + local.y * y.y + local.z * z.y,
                local.x * x.z + local.y * y.z + local.z * z.z};
    }
    PL_INLINE Real3<N> to_local(const Real3<N>& world) const { return {dot(world, x), dot(world, y), dot(world, z)}; }
};

/// Orthonormal frame around a unit normal. Branchless; continuous except where normal.z changes sign.   [Duff et al.
/// 2017, "Building an Orthonormal Basis, Revisited", JCGT 6(1)]
template <class N>
PL_INLINE FrameOf<N> make_frame(const Real3<N>& normal) {
    const auto sign = N::copy_sign(N::constant(1.0f), normal.z);
    const auto a = -1.0f / (sign + normal.z);
    const auto b = normal.x * normal.y * a;
    return {{1.0f + sign * normal.x * normal.x * a, sign * b, -sign * normal.x},
            {b, sign + normal.y * normal.y * a, -normal.y},
            normal};
}

/// The scalar frame.
struct Frame {
    Vec3f x, y, z;

    PL_HD Vec3f to_world(Vec3f local) const { return pack(unpacked().to_world(unpack(local))); }
    PL_HD Vec3f to_local(Vec3f world) const { return pack(unpacked().to_local(unpack(world))); }

private:
    PL_HD FrameOf<One> unpacked() const { return {unpack(x), unpack(y), unpack(z)}; }
};

PL_HD inline Frame make_frame(Vec3f normal) {
    const FrameOf<One> frame = make_frame(unpack(normal));
    return {pack(frame.x), pack(frame.y), pack(frame.z)};
}

}  // namespace pl

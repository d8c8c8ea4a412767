// Where the sun stands at a place and time.
#pragma once

#include <glm/glm.hpp>

namespace pl {

/// A place on the earth, and its local time.
struct SunTime {
    int year = 2010;
    int month = 7;  ///< from 1 to 12
    int day = 10;   ///< from 1
    double hour = 15.0, minute = 0.0, second = 0.0;
    double latitude = 35.6894;    ///< degrees, north is positive
    double longitude = 139.6917;  ///< degrees, east is positive
    double timezone = 9.0;        ///< hours that local time is ahead of universal time
};

/// Unit vector towards the sun: x to the east, y to the north, z up. Within half a minute of arc from 1999 to 2015, without refraction.
/// [Blanco-Muriel, Alarcon-Padilla, Lopez-Moratalla, Lara-Coira 2001, "Computing the Solar Vector", with its constants]
glm::dvec3 sun_towards(const SunTime& time);

}  // namespace pl

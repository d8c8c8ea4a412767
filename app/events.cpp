#include "app/events.h"

namespace pl {

std::string json_line(const Json& object) {
    constexpr bool kOnlyAscii = true;  // a terminal obeys characters beyond ASCII, too
    return object.dump(-1, ' ', kOnlyAscii, Json::error_handler_t::replace) + "\n";
}

std::string event_line(std::string_view kind, const Json& members) {
    Json object{{"schema", "pathlight.event/1"}, {"event", kind}};
    for (const auto& [name, value] : members.items()) object[name] = value;
    return json_line(object);
}

}  // namespace pl

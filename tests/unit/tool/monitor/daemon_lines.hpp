// SPDX-License-Identifier: MIT
// Lines of a daemon, for the monitor to read.
#pragma once

#include <string>

namespace cornerd::tool {

inline const std::string kVersionLine =
    R"({"class":"VERSION","program":"cornerd","version":"1.2.3","schema":2})";

inline std::string status_line(const std::string& lidar = R"("state":"running")",
                               const std::string& rest = "") {
  return R"({"class":"STATUS","t":101,"lidar":{)" + lidar + "}" + rest + "}";
}

inline const std::string kFixLine =
    R"({"class":"POSE","seq":9,"t":100.5,"state":"fix","x":1,"y":0.5,"theta":0,)"
    R"("cov":{"xx":4e-8,"xy":0,"xt":0,"yy":1e-8,"yt":0,"tt":1e-6},)"
    R"("room":"hall","corners":4,"inliers":210,"rmse":0.0021,"age":0,"p_wrong":2e-6})";
inline const std::string kLostLine =
    R"({"class":"POSE","seq":10,"t":100.6,"state":"lost","corners":1,"inliers":0,"age":3.5})";
inline const std::string kAmbiguousLine =
    R"({"class":"POSE","seq":11,"t":100.7,"state":"ambiguous","corners":4,"inliers":0,)"
    R"("alternatives":[{"x":0.5,"y":0.25,"theta":0,"score":0.6},)"
    R"({"x":1.5,"y":0.75,"theta":3.14159,"score":0.4}]})";
inline const std::string kPredictedLine =
    R"({"class":"POSE","seq":12,"t":100.8,"state":"predicted","x":1,"y":0.5,"theta":1.5708,)"
    R"("corners":0,"inliers":0,"age":1.25})";

}  // namespace cornerd::tool

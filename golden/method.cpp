#include "golden/method.h"

namespace golden {

std::string describe(Method method)
{
    switch (method) {
    case Method::ranks:
        return "same estimator, batch by batch (Mann-Whitney)";
    case Method::welch:
        return "another estimator, several pictures (Welch's t)";
    case Method::picture:
        return "a single picture, its noise assumed (Welch's t)";
    }
    return "";
}

} // namespace golden

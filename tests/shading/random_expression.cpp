#include "tests/shading/random_expression.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <stdexcept>

namespace burin::test {
namespace {

using Expression = RandomExpression;

template <typename Item>
Item pick(Random& random, std::initializer_list<Item> items) {
    return *(items.begin() + random.integer(0, static_cast<int>(items.size()) - 1));
}

Expression leaf(Random& random, bool is_triple) {
    Expression result;
    result.level = 9;
    result.is_triple = is_triple;
    if (is_triple) {
        if (random.integer(0, 2) == 0) {
            char text[16];
            std::array<int, 3> codes{random.integer(0, 255), random.integer(0, 255), random.integer(0, 255)};
            std::snprintf(text, sizeof text, "#%02x%02X%02x", codes[0], codes[1], codes[2]);
            result.word = text;
            for (std::size_t k = 0; k < 3; ++k) {
                const double code = codes[k] / 255.0;
                result.color[k] = code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
            }
        } else {
            result.word = pick<const char*>(random, {"C", "P", "N"});
            result.is_vector = result.word != "C";
        }
        return result;
    }
    if (random.integer(0, 2) == 0) {
        const float number = pick<float>(random, {0.0f, 1.0f, 2.0f, 0.5f, 3.0f, 10.0f, 0.1f, 1e-3f, 90.0f, 4.25f});
        char text[32];
        std::snprintf(text, sizeof text, "%.9g", static_cast<double>(number));
        result.word = text;
        result.number = static_cast<double>(number);
        return result;
    }
    result.word = pick<const char*>(random, {"depth", "facing", "light", "s", "t", "qi", "frame", "gap"});
    return result;
}

struct Shape {
    const char* word;
    std::size_t operands;
    int level;  ///< 9: a function
};

Expression made(Random& random, const Shape& shape, int depth, bool is_triple, bool with_noise) {
    Expression result;
    result.word = shape.word;
    result.level = shape.level;
    result.is_triple = is_triple;
    const auto forced = static_cast<std::size_t>(random.integer(0, static_cast<int>(shape.operands) - 1));
    for (std::size_t k = 0; k < shape.operands; ++k) {
        // One operand that has components is enough for a result that has.
        const bool triple = is_triple && (k == forced || random.integer(0, 1) == 0);
        result.operands.push_back(random_expression(random, depth - 1, triple, with_noise));
    }
    for (const Expression& operand : result.operands) {
        if (!operand.is_triple) continue;
        result.is_vector = operand.is_vector;
        break;
    }
    return result;
}

}  // namespace

RandomExpression random_expression(Random& random, int depth, bool is_triple, bool with_noise) {
    if (depth <= 0) return leaf(random, is_triple);
    const auto operand = [&](bool triple) { return random_expression(random, depth - 1, triple, with_noise); };
    Expression result;
    result.level = 9;
    result.is_triple = is_triple;
    switch (random.integer(0, 9)) {
        case 0:
        case 1:
        case 2:
            return made(
                random,
                pick<Shape>(
                    random,
                    {{"+", 2, 5}, {"-", 2, 5}, {"*", 2, 6}, {"/", 2, 6}, {"%", 2, 6}, {"^", 2, 8}, {"neg", 1, 7}}),
                depth, is_triple, with_noise);
        case 3:
        case 4:
            return made(random,
                        pick<Shape>(random, {{"abs", 1, 9},
                                             {"sign", 1, 9},
                                             {"floor", 1, 9},
                                             {"ceil", 1, 9},
                                             {"round", 1, 9},
                                             {"fract", 1, 9},
                                             {"sqrt", 1, 9},
                                             {"exp", 1, 9},
                                             {"exp2", 1, 9},
                                             {"log2", 1, 9},
                                             {"sind", 1, 9},
                                             {"cosd", 1, 9}}),
                        depth, is_triple, with_noise);
        case 5:
            return made(random,
                        pick<Shape>(random, {{"min", 2, 9},
                                             {"max", 2, 9},
                                             {"max", 3, 9},
                                             {"mod", 2, 9},
                                             {"pow", 2, 9},
                                             {"hypot", 2, 9},
                                             {"atan2d", 2, 9},
                                             {"step", 2, 9}}),
                        depth, is_triple, with_noise);
        case 6:
            return made(random,
                        pick<Shape>(random, {{"clamp", 3, 9}, {"mix", 3, 9}, {"smoothstep", 3, 9}, {"linstep", 3, 9}}),
                        depth, is_triple, with_noise);
        case 7: {
            const bool is_call = random.integer(0, 1) == 0;
            result = made(random, {"?", 2, is_call ? 9 : 0}, depth, is_triple, with_noise);
            if (is_call) result.word = pick<const char*>(random, {"if", "select"});
            result.operands.insert(result.operands.begin(), operand(false));
            return result;
        }
        case 8:
            if (is_triple) {
                result.word = pick<const char*>(random, {"rgb", "hsv", "normalize"});
                if (result.word == "normalize") {
                    result.operands.push_back(operand(true));
                    result.is_vector = result.operands[0].is_vector;
                } else {
                    for (int k = 0; k < 3; ++k) result.operands.push_back(operand(false));
                }
                return result;
            }
            result.word = pick<const char*>(random, {"luminance", "dot", "length", ".x", ".g", ".z"});
            result.operands.push_back(operand(true));
            if (result.word == "dot") result.operands.push_back(operand(true));
            return result;
        default:
            break;
    }
    if (is_triple) return leaf(random, true);
    if (with_noise && random.integer(0, 2) == 0) {
        result.word = pick<const char*>(random, {"noise", "noise3", "fbm"});
        result.operands.push_back(operand(result.word != "noise"));
        if (result.word == "noise") result.operands.push_back(operand(false));
        return result;
    }
    return made(random,
                pick<Shape>(random, {{"<", 2, 4},
                                     {"<=", 2, 4},
                                     {">", 2, 4},
                                     {">=", 2, 4},
                                     {"==", 2, 4},
                                     {"!=", 2, 4},
                                     {"and", 2, 2},
                                     {"or", 2, 1},
                                     {"not", 1, 3}}),
                depth, false, with_noise);
}

std::string written(const RandomExpression& e, Random& random) {
    const auto bracketed = [&](const Expression& operand, int least_level) {
        const std::string text = written(operand, random);
        return operand.level < least_level || random.integer(0, 9) == 0 ? "(" + text + ")" : text;
    };
    if (e.operands.empty()) return e.word;
    if (e.word.front() == '.') return bracketed(e.operands[0], 9) + e.word;
    const auto level = e.level;
    switch (level) {
        case 0:
            return bracketed(e.operands[0], 1) + " ? " + written(e.operands[1], random) + ":" +
                   written(e.operands[2], random);
        case 3:
            return "not " + bracketed(e.operands[0], 3);
        case 7:
            return "-" + bracketed(e.operands[0], 7);
        case 8:
            return bracketed(e.operands[0], 9) + "^" + bracketed(e.operands[1], 7);
        case 9: {
            std::string text = e.word + "(";
            for (std::size_t k = 0; k < e.operands.size(); ++k)
                text += (k > 0 ? ", " : "") + written(e.operands[k], random);
            return text + (e.word == "fbm" ? ", 3)" : ")");
        }
        default:
            return bracketed(e.operands[0], level == 4 ? 5 : level) + " " + e.word + " " +
                   bracketed(e.operands[1], level + 1);
    }
}

}  // namespace burin::test

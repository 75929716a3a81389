// What a text means, by its value at (x, y, z) = (2, 3, 5).
#include <cmath>
#include <numbers>

#include "tests/frontend/parse.h"

namespace imp {
namespace {

using test::value;

struct Row {
  const char* text;
  double expected;
};

void PrintTo(const Row& row, std::ostream* out) { *out << testing::PrintToString(row.text); }

class Grammar : public testing::TestWithParam<Row> {};

TEST_P(Grammar, means) {
  const auto [text, expected] = GetParam();
  const double found = value(text);
  const bool same =
      std::isnan(expected) ? std::isnan(found) : std::abs(found - expected) <= 1e-14 * std::abs(expected);
  EXPECT_TRUE(same) << found << ", not " << expected << ": " << text;
}

#define GRAMMAR(name, ...) \
  INSTANTIATE_TEST_SUITE_P(name, Grammar, testing::ValuesIn(std::vector<Row>{__VA_ARGS__}))

GRAMMAR(Precedence,            //
        {"x + y*z", 17},       //
        {"(x + y)*z", 25},     //
        {"z - y - x", 0},      //
        {"z/x/y", 5.0 / 6},    //
        {"-x^2", -4},          //
        {"(-x)^2", 4},         //
        {"2^-1", 0.5},         //
        {"2^-x^2", 1.0 / 16},  //
        {"2^3^2", 512},        //
        {"(2^3)^2", 64},       //
        {"-x*-y", 6},          //
        {"- - x", 2},          //
        {"--x", 2},            //
        {"-+-+-x", -2},        //
        {"x - -y", 5},         //
        {"2*x^2*y", 24},       //
        {"x^2/y^2", 4.0 / 9},  //
        {"-2^2", -4},          //
        {"x^y^2", 512},        //
        {"x*y^-1", 2.0 / 3});

GRAMMAR(Bars,                   //
        {"|x - y|", 1},         //
        {"|x - |y - z||", 0},   //
        {"||x - z| - y|", 0},   //
        {"|x|*|y|", 6},         //
        {"2 - |x - y|*3", -1},  //
        {"|x - y|^2", 1},       //
        {"-|x|", -2},           //
        {"||x||", 2},           //
        {"|(|x| - |z|)|", 3},   //
        {"sqrt(|x - z| + 1)", 2});

GRAMMAR(Equations,                          //
        {"x = y", -1},                      //
        {"x + y = z", 0},                   //
        {"z = x^2 - y^2", 10},              //
        {"x^2 + y^2 = 0", 13},              //
        {"x - y", -1},                      //
        {"y = 1 - 1", 3},                   //
        {"0 = x", -2},                      //
        {"sin(x) = z", std::sin(2.0) - 5},  //
        {"T(2, x) = 0", 7},                 //
        {"surface s: x = y", -1},           //
        {"surface s:\n  x\n  = y", -1});

GRAMMAR(Names,                                                       //
        {"a = 3\nx = a", -1},                                        //
        {"x = a\na = b + 1\nb = 2", -1},                             //
        {"q(x) = x^2\n1*q(y) = z", 4},                               //
        {"q(a, b) = a^2 - b^2\nq(z, y) + q(x, 0)", 20},              //
        {"q(a) = a*x\nq(q(y))", 12},                                 //
        {"x^2 = r\nr = y - 1", 2},                                   //
        {"sin = 4\nx = sin", -2},                                    //
        {"sin(a) = a + 1\nsin(x) + y = 0", 6},                       //
        {"T = 4\nx*T", 8},                                           //
        {"T(a) = a^2\nx + T(y)", 11},                                //
        {"pi = 3\nx*pi", 6},                                         //
        {"sum(a, b, c, d) = a + b + c + d\n1*sum(x, y, z, 1)", 11},  //
        {"e = exp(1)\nlog(e)*x", 2},                                 //
        {"f(x) = x + 1\ng(y) = f(y) + f(x)\n1*g(z) = 0", 9},         //
        {"f(i) = sum(i, 1, 3, i)\nf(x) + 0*x", 6},                   //
        {"f(a) = sum(i, 1, 3, sum(j, 1, i, a*i*j))\nf(y) + x", 77});

GRAMMAR(Keywords,                                                                    //
        {"time = 3\nx*time", 6},                                                     //
        {"light = 2*x\nlight + 1", 5},                                               //
        {"domain(x) = x^2\n1*domain(y)", 9},                                         //
        {"param = 1\nx + param", 3},                                                 //
        {"surface = 2\nsurface s: surface = x", 0},                                  //
        {"camera(a) = a\nx + camera(y)", 5},                                         //
        {"isovalues = 7\nisovalues - x", 5},                                         //
        {"import = 1\nsolid = 2\nmaterial = 3\nx - import - solid - material", -4},  //
        {"not = 1\nand = 2\nor = 3\nx + not + and + or", 8},                         //
        {"in = 1\nwhere = 2\nx*in + where", 4},                                      //
        {"fov = 1\nup = 2\nfrom = 3\nx + fov + up + from\ncamera from (0, 0, up) to (1, 1, 1) fov 30*fov",
         8});

GRAMMAR(Lines,                                    //
        {"x\n + y\n + z", 10},                    //
        {"  x\n   + y", 5},                       //
        {"x + (y\n+ z)", 10},                     //
        {"a = (1 +\n2)\n\n\nx*a # the end", 6},   //
        {"max(x,\ny\n,z)", 5},                    //
        {"x   # + 1\n\n   # nothing\n  + y", 5},  //
        {"# first\nx\n# last", 2},                //
        {"\tx\n\t\t+ y", 5},                      //
        {"x\r\n  + y\r\n", 5},                    //
        {"\xEF\xBB\xBFx + y", 5},                 //
        {"x + y # \xC3\xA4 \xFF\x01", 5},         //
        {"surface a:\n    x = 1\n\nb = 2", 1},    //
        {"  b = 2\n  surface a:\n    x = b", 0},  //
        {"    b = 2\nsurface a: x = b", 0},       //
        {"b = 1\n  + 2\nx = b", -1},              //
        {"x\n \n \n      +\n  y", 5});

GRAMMAR(Conditions,                                   //
        {"if(x < y, 1, 2)", 1},                       //
        {"if(x > y, 1, 2)", 2},                       //
        {"if(x <= 2, 1, 2)", 1},                      //
        {"if(x >= 3, 1, 2)", 2},                      //
        {"if(x < y and y < z, 1, 2)", 1},             //
        {"if(x > y or y < z, 1, 2)", 1},              //
        {"if(not x < y, 1, 2)", 2},                   //
        {"if(not (x < y and y < x), 1, 2)", 1},       //
        {"if(x < y or y < x and z < 0, 1, 2)", 1},    //
        {"if((x < y or y < x) and z < 0, 1, 2)", 2},  //
        {"if(((x)) < (y + 1), 1, 2)", 1},             //
        {"if((x + 1)*2 < (y), 1, 2)", 2},             //
        {"if(((x < y)), 1, 2)", 1},                   //
        {"if(|x - y| < 2, 1, 2)", 1},                 //
        {"if(x < 0, 1, if(y < 0, 2, 3))", 3},         //
        {"if(sqrt(-x) < 1, 1, 2)", 2},                //
        {"if(not sqrt(-x) < 1, 1, 2)", 1});

GRAMMAR(Functions,                                                                                  //
        {"sqrt(x)", std::sqrt(2.0)},                                                                //
        {"cbrt(-27)*x", -6},                                                                        //
        {"exp(x)", std::exp(2.0)},                                                                  //
        {"log(x)", std::log(2.0)},                                                                  //
        {"sin(x) + 0", std::sin(2.0)},                                                              //
        {"cos(x) + tan(y)", std::cos(2.0) + std::tan(3.0)},                                         //
        {"asin(1/x) + acos(1/y)", std::asin(0.5) + std::acos(1.0 / 3)},                             //
        {"atan(x) - atan2(y, -x)", std::atan(2.0) - std::atan2(3.0, -2.0)},                         //
        {"sinh(x) + cosh(y) + tanh(z)", std::sinh(2.0) + std::cosh(3.0) + std::tanh(5.0)},          //
        {"asinh(x) + acosh(y) + atanh(1/z)", std::asinh(2.0) + std::acosh(3.0) + std::atanh(0.2)},  //
        {"floor(x/y) + ceil(x/y)", 1},                                                              //
        {"sign(x - y)", -1},                                                                        //
        {"mod(-x, y)", 1},                                                                          //
        {"abs(x - z)", 3},                                                                          //
        {"min(z, x)", 2},                                                                           //
        {"max(x, z, y)", 5},                                                                        //
        {"min(z, y, x, 4)", 2},                                                                     //
        {"pow(x, 3)", 8},                                                                           //
        {"pow(x, 1/2)", std::sqrt(2.0)},                                                            //
        {"x^0.5", std::sqrt(2.0)},                                                                  //
        {"x^y", 8},                                                                                 //
        {"(-x)^y", NAN},                                                                            //
        {"(-x)^3", -8},                                                                             //
        {"(x - 2)^0", 1},                                                                           //
        {"pi*x", 2 * std::numbers::pi},                                                             //
        {"T(0, x)", 1},                                                                             //
        {"T(1, x)", 2},                                                                             //
        {"T(2, x)", 7},                                                                             //
        {"T(3, x)", 26},                                                                            //
        {"T(6, x)", 1351},                                                                          //
        {"T(7, x)", 5042},                                                                          //
        {"T(11, x)", 978122},                                                                       //
        {"T(2, T(3, x))", 1351},                                                                    //
        {"sum(i, 1, 4, i*x)", 20},                                                                  //
        {"sum(i, -1, 1, x^i)", 3.5},                                                                //
        {"sum(i, 2, 1, x)", 0},                                                                     //
        {"product(i, 2, 1, x)", 1},                                                                 //
        {"product(i, 1, 3, x + i)", 60},                                                            //
        {"sum(i, 1, 2, T(i, x))", 9},                                                               //
        {"sum(i, 1, 3, product(j, 1, i, j))", 9},                                                   //
        {"n = 3\nsum(i, 1, n + 1, i) + x", 12},                                                     //
        {"sum(x, 1, 3, x)", 6},                                                                     //
        {"s(n, a) = sum(k, 0, n, a^k)\ns(3, x) = 0", 15});

GRAMMAR(Numbers,                                                        //
        {"0.1*x", 0.2},                                                 //
        {"11.8 + 0*x", 11.8},                                           //
        {"1e3*x", 2000},                                                //
        {"1E+2*x", 200},                                                //
        {"25e-1*x", 5},                                                 //
        {"1.50e1*x", 30},                                               //
        {"007*x", 14},                                                  //
        {"0.000*x", 0},                                                 //
        {"1e30*x", 2e30},                                               //
        {"1e-30*x", 2e-30},                                             //
        {"0e999*x", 0},                                                 //
        {"12345678901234567890*x", 24691357802469135780.0},             //
        {"0.12345678901234567890123456789*x", 0.24691357802469135780},  //
        {"3.14159265358979323846*x", 2 * std::numbers::pi},             //
        {"1e308/x*2", 1e308});

}  // namespace
}  // namespace imp

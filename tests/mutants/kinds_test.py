"""Each kind of mutants on small pieces of C++, and text in which nothing may be changed."""

import unittest

import generate
from cpp_source import Source
from operands import declared_types


def made(kind, body):
    """What a kind makes of a function: the changed lines of each mutant, without the space around them. The parameters are
    used once more, since no mutant leaves one unused."""
    head = "void f(double a, double b, int s, int t, const Vec3& v)"
    source = Source("ref/trees/f.h", f"{head}\n{{\n{body}\nuse(a, b, s, t, v);\n}}\n")
    every = generate.candidates_of(source, declared_types([source]), "ref/trees")
    return [" ".join(c.replaced.split()) for c in every if c.kind == kind and not c.replaced.startswith("use(")]


class Kinds(unittest.TestCase):
    def expect(self, kind, body, *mutants):
        self.assertEqual(sorted(made(kind, body)), sorted(mutants))

    def test_plus_minus(self):
        self.expect("plus_minus", "x = a + b;\ny -= -a;", "x = a - b;", "y += -a;")
        self.expect("plus_minus", "for (int i = 0; i < s; i += 2) g();")  # it would not end

    def test_times_over(self):
        body = "const double* const p = &a;\nx = a * *p / b;"
        self.expect("times_over", body, "x = a / *p / b;", "x = a * *p * b;")

    def test_drop_factor(self):
        body = "return 2.0 * v * (a + b) / std::abs(a);"
        without = ("v * (a + b) / std::abs(a);", "2.0 * v / std::abs(a);", "2.0 * v * (a + b);")
        self.expect("drop_factor", body, *("return " + product for product in without))

    def test_drop_factor_leaves_no_unused_name(self):
        self.expect("drop_factor", "const double c = 1;\nreturn v * c;")
        self.expect("drop_factor", "const double c = 1;\ng(c);\nreturn v * c;", "return v;")

    def test_drop_factor_keeps_what_may_be_a_vector(self):
        self.expect("drop_factor", "const auto w = g();\nuse(w);\nreturn v * w;")

    def test_forget_call(self):
        self.expect("forget_call", "x = std::abs(a);\nreturn glm::normalize(v);", "x = (a);", "return (v);")

    def test_less(self):
        body = "c = a < b && b >= static_cast<int>(d->e);"
        self.expect("less", body, body.replace("a < b", "a <= b"), body.replace(">=", ">"))

    def test_less_knows_that_no_unsigned_number_is_negative(self):
        self.expect("less", "std::size_t n = 1;\nif (n > 0) g();\nif (a > 0) g();", "if (a >= 0) g();")

    def test_equal(self):
        self.expect("equal", "return s == t;", "return s != t;")

    def test_and_or_changes_all_of_a_condition(self):
        # One && beside || would need parentheses.
        self.expect("and_or", "return a < b && g(s) && t > 1;", "return a < b || g(s) || t > 1;")
        self.expect("and_or", "return (s && t) || !c;", "return (s || t) || !c;", "return (s && t) && !c;")

    def test_min_max(self):
        body = "return std::min(a, std::numeric_limits<double>::max());"
        self.expect("min_max", body, body.replace("min(", "max("))

    def test_drop_not(self):
        self.expect("drop_not", "if (!(a != b)) return;", "if ((a != b)) return;")

    def test_drop_minus(self):
        self.expect("drop_minus", "return {-a, b - a};", "return {a, b - a};")

    def test_relaxed(self):
        self.expect("relaxed", "n.fetch_add(1, std::memory_order_acq_rel);", "n.fetch_add(1, std::memory_order_relaxed);")
        self.expect("relaxed", "n.load(std::memory_order::acquire);", "n.load(std::memory_order::relaxed);")
        self.expect("relaxed", "__atomic_load_n(p, __ATOMIC_ACQUIRE);", "__atomic_load_n(p, __ATOMIC_RELAXED);")

    def test_constant(self):
        self.expect("constant", "return 2.0f * c[2] + 0x1p-3 + 0b1'0;", "return 1.0f * c[2] + 0x1p-3 + 0b1'0;")
        self.expect("constant", "return 0.5 * a + 0;", "return 1.0 * a + 0;")
        self.expect("constant", "return 32 * b;", "return 31 * b;")
        self.expect("constant", "return 1.0 - a * 1.0;", "return 2.0 - a * 1.0;")

    def test_shift_mask(self):
        self.expect("shift_mask", "x = s << 2 | t;\nc = (s & 1) != 0;", "x = s >> 2 | t;", "c = (s | 1) != 0;")

    def test_flip_bool(self):
        self.expect("flip_bool", "return true;", "return false;")

    def test_off_by_one(self):
        body = "for (int i = 0; i < n - 1; ++i) x += c[i] * c[2] + 1.0;"
        changes = (("i = 0", "i = 1"), ("n - 1", "n"), ("[i]", "[i + 1]"), ("[2]", "[1]"))
        self.expect("off_by_one", body, *(body.replace(*change) for change in changes))

    def test_off_by_one_leaves_declarations(self):
        self.expect("off_by_one", "double c[3];\nconst auto [first, last] = g();\nh([&](int i) { return i; });")

    def test_swapped_axis(self):
        self.expect("swapped_axis", "return v.x * x + v.z;", "return v.y * x + v.z;", "return v.x * x + v.x;")

    def test_swapped_name(self):
        self.expect("swapped_name", "const int k = s + 1;", "const int k = t + 1;")
        self.expect("swapped_name", "g(p.pdf_fwd, p.pdf_rev);", "g(p.pdf_rev, p.pdf_rev);", "g(p.pdf_fwd, p.pdf_fwd);")
        self.expect("swapped_name", "const bool first = g();\nconst Vertex last = h();\nk(first, last, first, last);")
        self.expect("swapped_name", "return p.light;\nfor (int left : g()) h(left);")  # no other one is there

    def test_swapped_arguments(self):
        self.expect("swapped_arguments", "g(a, b, v);\nstd::min(a, b);", "g(b, a, v);")
        self.expect("swapped_arguments", "int n = 0;\nint many[3];\ng(n, many);")
        self.expect("swapped_arguments", "g(u[1], u[2]);", "g(u[2], u[1]);")

    def test_negate_condition(self):
        self.expect("negate_condition", "if (a < b) g();", "if (!(a < b)) g();")
        self.expect("negate_condition", "x = s == 0 ? a : b;", "x = !(s == 0) ? a : b;")
        self.expect("negate_condition", "return g(s) ? a : b;", "return !(g(s)) ? a : b;")
        self.expect("negate_condition", "if constexpr (n) g();\nif (!c) g();\nif (auto* p = h()) g();")

    def test_skip_update(self):
        self.expect("skip_update", "for (int i = 0; i < s; i += 2) sum += a;", "for (int i = 0; i < s; i += 2) {}")
        self.expect("skip_update", "++n;\nconst int k = 1;\nlist.push_back({a, b});", "", "")

    def test_drop_guard(self):
        self.expect("drop_guard", "if (s == 0) return;\nif (t > 0) { g(); }\nif (a < b)\n    continue;", "", "")

    def test_every_kind_has_a_test(self):
        tests = [name.removeprefix("test_") for name in dir(self) if name.startswith("test_")]
        for kind in generate.KINDS:
            self.assertTrue(any(name.startswith(kind.__name__) for name in tests), kind.__name__)


class NothingToChange(unittest.TestCase):
    def expect_none(self, text):
        source = Source("ref/trees/f.h", text)
        every = generate.candidates_of(source, declared_types([source]), "ref/trees")
        self.assertEqual([c.title for c in every], [])

    def test_comments_strings_and_directives(self):
        self.expect_none("#if A < B && \\\n  C > 1\n#endif\nint a; // x = a + b;\n")
        self.expect_none('void f()\n{\n    /* if (a < b)\n return; */\n    g("a + 1", R"(x = 2 * 3)", \'+\');\n}\n')

    def test_text_in_a_statement(self):
        self.expect_none('void f()\n{\n    out << "n = " << n + 2;\n    throw std::length_error(n < 2 ? a : b);\n}\n')

    def test_templates_references_and_pointers(self):
        self.expect_none("template <class F, int N = 2>\nHD const Vec3Of<F>& f(const std::span<const Box>& x, F&& y, int n = 3);\n")
        self.expect_none("void f()\n{\n    const double* const p = g<F, true>(x);\n    const Box& box(h<3>(*p, &y));\n}\n")

    def test_declarations(self):
        self.expect_none("struct A : B<3> {\n    enum class C { d, e = 2 };\n    int n = 2;\n    A& operator*() const;\n};\n")
        self.expect_none("static_assert(sizeof(int) == 4 && 1 < 2);\nusing A = B<true>;\nbool operator<(A, A) = default;\n")


if __name__ == "__main__":
    unittest.main()

// C++17: a solver and the arrays of its curve in objects that clean up after themselves. An ear and a tail of one creature.
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <vector>
#include <wiggly/wiggly.h>

namespace
{

void check(wiggly_status status)
{
    if (status >= WIGGLY_ERROR_ARGUMENT) throw std::runtime_error(wiggly_status_text(status));
}

class Solver
{
  public:
    Solver(int samples, int knots)
    {
        wiggly_solver *made = nullptr;
        check(wiggly_create(samples, knots, &made));
        solver.reset(made);
    }

    wiggly_status solve(const wiggly_desc &desc, wiggly_curve &curve)
    {
        return wiggly_solve(solver.get(), &desc, &curve);
    }

  private:
    struct Destroy {
        void operator()(wiggly_solver *solver) const { wiggly_destroy(solver); }
    };
    std::unique_ptr<wiggly_solver, Destroy> solver;
};

/// A solved spline that owns its samples. A copy is a spline of its own; what is moved keeps its addresses.
class Spline
{
  public:
    Spline(Solver &solver, wiggly_desc desc, const std::vector<wiggly_knot> &knots)
        : arrays(static_cast<std::size_t>(desc.samples) * 5), length(desc.samples)
    {
        desc.knots = knots.data();
        desc.knot_count = static_cast<int>(knots.size());
        attach();
        check(solver.solve(desc, curve));
    }

    Spline(const Spline &other) : arrays(other.arrays), length(other.length), curve(other.curve) { attach(); }
    Spline(Spline &&) noexcept = default;
    Spline &operator=(Spline other) noexcept
    {
        arrays.swap(other.arrays);
        length = other.length;
        curve = other.curve;
        return *this;
    }

    /// At a time in seconds, `lag` radians late.
    double at(double seconds, double lag = 0) const
    {
        return wiggly_lagged(wiggly_evaluate_at(&curve, seconds, nullptr), lag);
    }

  private:
    void attach()
    {
        curve.size = sizeof curve;
        double **const columns[] = {&curve.total, &curve.y, &curve.re, &curve.im, &curve.omega};
        double *column = arrays.data();
        for (double **to : columns) {
            *to = column;
            column += length;
        }
    }

    std::vector<double> arrays;
    int length;
    wiggly_curve curve = {};
};

wiggly_desc swinging(double hertz)
{
    wiggly_desc desc = wiggly_default_desc();
    desc.samples = 97;
    desc.frequency.value = hertz;
    desc.damping.value = 0.1;
    return desc;
}

wiggly_knot knot(int sample, double value)
{
    wiggly_knot made = {};
    made.sample = sample;
    made.value = value;
    return made;
}

} // namespace

int main()
{
    try {
        Solver solver(97, 3);
        std::vector<Spline> parts;
        parts.emplace_back(solver, swinging(2.5), std::vector<wiggly_knot>{knot(0, 0), knot(30, 0.4)});
        parts.emplace_back(solver, swinging(1.2), std::vector<wiggly_knot>{knot(0, 0), knot(24, 1), knot(60, -1)});
        std::printf("seconds,ear,tail,tip\n");
        for (int frame = 0; frame <= 240; frame++) {
            double seconds = frame / 60.0;
            std::printf("%.4f,%.5f,%.5f,%.5f\n", seconds, parts[0].at(seconds), parts[1].at(seconds),
                        parts[1].at(seconds, 2.5));
        }
    } catch (const std::exception &problem) {
        std::fprintf(stderr, "%s\n", problem.what());
        return 1;
    }
}

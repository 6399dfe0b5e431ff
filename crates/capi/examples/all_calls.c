/* Every call of windlass.h, with numbers by hand; prints what differs and returns how many. Built and run by .ci/peers, under valgrind too. */
#include "windlass.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static int wrong = 0;

static void expect(int holds, const char *what) {
    if (!holds) {
        printf("wrong: %s (last error: %s)\n", what, windlass_last_error());
        wrong += 1;
    }
}

static void near(double found, double wanted, double tolerance, const char *what) {
    if (!(fabs(found - wanted) <= tolerance)) {
        printf("wrong: %s is %.12g, not %.12g\n", what, found, wanted);
        wrong += 1;
    }
}

static size_t column(const windlass_session *w, const char *name) {
    for (size_t c = 0; c < windlass_table_columns(w, 0); c++) {
        if (strcmp(windlass_table_name(w, 0, c), name) == 0) return c;
    }
    printf("wrong: there is no column %s\n", name);
    wrong += 1;
    return 0;
}

static void sessions(const char *root) {
    windlass_session *w = windlass_session_new(root);
    expect(w != NULL, "a new session");
    const char *model =
        "&DIMEN -DIMEN METERS K-NTS\n&ENV -DEPTH 100\nMEDIT\n&DESCRIBE BODY BUOY -IGNORE Z RX RY RZ\n*CG 0 0 0\n*F 0 0 0\n"
        "#WEIGHT *CG 100 2 2 2\n~W B_CAT 100 -LEN 300 -WTPLEN 1 -EMODULUS 1E12 -BUOYDIAMETER 0 -DEPANCHOR 100\n"
        "CONNECTOR A -ANC 0 200 ~W *F\nEND\n&STATUS F_CONNECTOR";
    expect(windlass_session_run(w, model) == WINDLASS_DONE, "the model");
    expect(windlass_session_tables(w) == 1 && windlass_table_rows(w, 0) == 1, "one table of one row");
    expect(strstr(windlass_session_text(w), "Ten Top") != NULL, "the printed report");
    expect(windlass_table_title(w, 0) != NULL && windlass_table_title(w, 1) == NULL, "the title of the only table");
    double tension = 0;
    size_t c = column(w, "Ten Top (kN)");
    expect(windlass_table_numbers(w, 0, c, &tension, 1) == WINDLASS_DONE, "the tension");
    /* 100 m of a line of 1 kN/m hang straight down */
    near(tension, 100.0, 1e-6, "tension (kN)");
    expect(strcmp(windlass_table_unit(w, 0, c), "kN") == 0, "the unit of the tension");
    expect(strcmp(windlass_table_text(w, 0, column(w, "Name"), 0), "A") == 0, "the name of the line");
    expect(windlass_table_text(w, 0, c, 0) == NULL && windlass_table_text(w, 0, 0, 9) == NULL, "no text of a number, or past the end");
    expect(windlass_table_numbers(w, 0, c, &tension, 0) == WINDLASS_WRONG_CALL, "no room");
    expect(windlass_table_numbers(w, 0, 99, &tension, 1) == WINDLASS_WRONG_CALL, "no such column");
    expect(windlass_table_name(w, 0, 99) == NULL && windlass_table_unit(w, 9, 0) == NULL, "no such name");
    expect(windlass_session_run(w, "&ENV -DEPTH 100\n  &ENV -DEPTH deep") == WINDLASS_REFUSED, "a wrong record");
    expect(windlass_session_error_line(w) == 2 && windlass_session_error_column(w) == 15, "its place");
    expect(strstr(windlass_session_error(w), "^^^^") != NULL && strstr(windlass_last_error(), "deep") != NULL, "its text");
    expect(windlass_session_run(w, "&SET A = 1") == WINDLASS_DONE && windlass_session_error_line(w) == 0, "the session goes on");
    expect(strlen(windlass_session_error(w)) == 0 && strlen(windlass_session_warnings(w)) == 0, "no error left");
    expect(windlass_session_run_file(w, "/no/such/file.cif") == WINDLASS_REFUSED, "a file that is not there");
    expect(windlass_session_run(w, NULL) == WINDLASS_WRONG_CALL, "no records");
    expect(windlass_session_run(w, "\xff\xfe") == WINDLASS_WRONG_CALL, "no UTF-8");
    expect(windlass_session_run(NULL, "") == WINDLASS_WRONG_CALL && windlass_session_tables(NULL) == 0, "no session");
    expect(windlass_session_new(NULL) == NULL && strlen(windlass_session_text(NULL)) == 0, "no root");
    windlass_session_free(w);
    windlass_session_free(NULL);
}

static void catenaries(void) {
    /* sinh: a line of 2 a sinh(1) hangs between two points 2 a apart, H = w a */
    double a[3] = {50, 100, 400}, x[3], z[3] = {0, 0, 0}, length[3], ea[3], w[3], h[3], v[3], ah[3], av[3], grounded[3];
    size_t failed = 9;
    for (int i = 0; i < 3; i++) {
        x[i] = 2 * a[i];
        length[i] = 2 * a[i] * sinh(1.0);
        ea[i] = 1e18;
        w[i] = 1000;
    }
    expect(windlass_catenary_solve(3, x, z, length, ea, w, NULL, 0, h, v, ah, av, grounded, &failed) == WINDLASS_DONE, "the catenary");
    for (int i = 0; i < 3; i++) {
        near(h[i], 1000 * a[i], 1e-6 * h[i], "H (N)");
        near(v[i], 1000 * a[i] * sinh(1.0), 1e-6 * h[i], "V (N)");
    }
    expect(failed == 0, "none failed");
    length[1] = -1;
    expect(windlass_catenary_solve(3, x, z, length, ea, w, NULL, 0, h, NULL, NULL, NULL, NULL, &failed) == WINDLASS_REFUSED, "a negative length");
    expect(failed == 1 && isnan(h[1]) && !isnan(h[2]) && strstr(windlass_last_error(), "line 1") != NULL, "which is named");
    expect(windlass_catenary_solve(3, NULL, z, length, ea, w, NULL, 0, h, NULL, NULL, NULL, NULL, NULL) == WINDLASS_WRONG_CALL, "no x");
    expect(windlass_catenary_solve(0, NULL, NULL, NULL, NULL, NULL, NULL, 1, NULL, NULL, NULL, NULL, NULL, NULL) == WINDLASS_DONE, "no lines");
}

static void dynamics(void) {
    windlass_line line = {.length = 100, .mass = 0.01, .ea = 1e6, .diameter = 0.01, .elements = 10, .fairlead = {101, 0, 0}};
    windlass_surroundings around = {.gravity = 9.81, .depth = NAN, .longest_step = 0.5};
    windlass_dynamics *d = windlass_dynamics_new(&line, 1, &around);
    expect(d != NULL, "a taut line");
    double force[3] = {0, 0, 0}, v[3] = {0.05, 0, 0}, x[3] = {101, 0, 0};
    for (int t = 1; t <= 20; t++) {
        x[0] = 101 + 0.05 * t;
        expect(windlass_dynamics_step(d, t, x, v, force) == WINDLASS_DONE, "a step");
    }
    /* EA times strain */
    near(force[0], -2e4, 20, "force on the fairlead (N)");
    expect(windlass_dynamics_anchor_forces(d, force) == WINDLASS_DONE, "the force on the anchor");
    near(force[0], 2e4, 20, "force on the anchor (N)");
    expect(windlass_dynamics_step(d, 1, x, v, force) == WINDLASS_REFUSED, "a step back");
    expect(windlass_dynamics_step(d, 21, NULL, v, NULL) == WINDLASS_WRONG_CALL, "no place");
    expect(windlass_dynamics_step(d, 21, x, v, NULL) == WINDLASS_DONE, "a step whose force is not wanted");
    expect(windlass_dynamics_step(NULL, 21, x, v, force) == WINDLASS_WRONG_CALL, "no lines");
    windlass_dynamics_free(d);
    windlass_dynamics_free(NULL);
    /* a taut vertical line in a wave of 10 s and 2 m in 50 m of water feels Morison's force: python/tests/test_dynamics.py has the integral */
    windlass_line stiff = {.length = 9.99, .mass = 100, .ea = 1e9, .diameter = 0.3, .cd_normal = 1.2, .ca_normal = 1, .elements = 50,
                           .anchor = {0, 0, -20}, .fairlead = {0, 0, -10}};
    windlass_surroundings sea = {.density = 1025, .gravity = 9.80665, .depth = 50, .longest_step = 0.05, .environment = "-WAVES 10 2 0 180 -RAMP 20"};
    d = windlass_dynamics_new(&stiff, 1, &sea);
    expect(d != NULL, "a line in waves");
    double top[3] = {0, 0, -10}, rest[3] = {0, 0, 0}, other[3];
    expect(windlass_dynamics_step(d, 47.5, top, rest, force) == WINDLASS_DONE, "a step in waves");
    expect(windlass_dynamics_anchor_forces(d, other) == WINDLASS_DONE, "the force on the anchor");
    near(force[0] + other[0], 661.5, 5, "Morison's force (N)");
    windlass_dynamics_free(d);
    sea.environment = "-SEE JONSWAP";
    expect(windlass_dynamics_new(&stiff, 1, &sea) == NULL && strstr(windlass_last_error(), "-SEE") != NULL, "no option of &ENV");
    line.mass = -1;
    expect(windlass_dynamics_new(&line, 1, &around) == NULL && strstr(windlass_last_error(), "mass") != NULL, "a negative mass");
    expect(windlass_dynamics_new(NULL, 1, &around) == NULL && windlass_dynamics_new(&line, 1, NULL) == NULL, "no line, no surroundings");
}

int main(int count, char **words) {
    expect(strlen(windlass_version()) > 0, "the version");
    sessions(count > 1 ? words[1] : "job");
    catenaries();
    dynamics();
    printf("%d wrong\n", wrong);
    return wrong != 0;
}

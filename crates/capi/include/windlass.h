/* The C interface of windlass: sessions of records, the catenary over arrays, dynamic lines for a time loop.
 *
 * SI units (m, kg, N, s), z up from the mean water level; tables have the units that the records chose, named with each column.
 *
 * A handle is used by one thread at a time. Texts are UTF-8 and end in NUL. Texts that are returned belong to the library: those of a session
 * stand until its next call, that of windlass_last_error until the next call of the thread. Arrays that are filled are apart from those that
 * are read. Null is refused wherever a pointer is not said to be one that may be left out. No call ends the program.
 */
#ifndef WINDLASS_H
#define WINDLASS_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What calls return. */
enum {
    WINDLASS_DONE = 0,       /* all is done */
    WINDLASS_REFUSED = 1,    /* a record, a line or a step was refused: windlass_last_error says why */
    WINDLASS_WRONG_CALL = 2, /* a null pointer, an index out of range, a text that is not UTF-8 */
    WINDLASS_INTERNAL = 3    /* a defect of windlass: the handle is not to be relied on */
};

/* The version of the library, as "0.2.0". */
const char *windlass_version(void);

/* Why the last call of this thread did not do what it was asked. */
const char *windlass_last_error(void);

/* ---- Sessions ------------------------------------------------------------------------------------------------------------------------- */

/* A session of records. A call stops at its first error: the records before it acted, it changed nothing, those behind it were not read. Menus
 * stay open between calls. */
typedef struct windlass_session windlass_session;

/* A new session; its answers go to the folder ROOT.ans. Null where the root is refused. */
windlass_session *windlass_session_new(const char *root);

/* Frees a session; null is left as it is. */
void windlass_session_free(windlass_session *session);

/* Runs records. */
int windlass_session_run(windlass_session *session, const char *records);

/* Runs a script, or an AQWA deck. */
int windlass_session_run_file(windlass_session *session, const char *path);

/* What the last call printed; its error, with the record and the word underlined; its warnings and notes. */
const char *windlass_session_text(const windlass_session *session);
const char *windlass_session_error(const windlass_session *session);
const char *windlass_session_warnings(const windlass_session *session);

/* Line and column of the word that the error of the last call is about, from 1; 0 without one. */
size_t windlass_session_error_line(const windlass_session *session);
size_t windlass_session_error_column(const windlass_session *session);

/* How many tables the last call showed; they are numbered from 0. */
size_t windlass_session_tables(const windlass_session *session);

/* Title, rows and columns of a table; null or 0 of one that is not there. */
const char *windlass_table_title(const windlass_session *session, size_t table);
size_t windlass_table_rows(const windlass_session *session, size_t table);
size_t windlass_table_columns(const windlass_session *session, size_t table);

/* Name of a column with its unit in brackets, and the unit alone, empty of plain numbers and text; null of one that is not there. */
const char *windlass_table_name(const windlass_session *session, size_t table, size_t column);
const char *windlass_table_unit(const windlass_session *session, size_t table, size_t column);

/* The numbers of a column into room for `count`, which is no less than the rows; NaN where there is none. */
int windlass_table_numbers(const windlass_session *session, size_t table, size_t column, double *values, size_t count);

/* The text of a cell of a column of text; null of any other. */
const char *windlass_table_text(const windlass_session *session, size_t table, size_t column, size_t row);

/* ---- The catenary --------------------------------------------------------------------------------------------------------------------- */

/* Forces of `count` single lines whose fairleads are `x` beside and `z` above their anchors (m), of an unstretched `length` (m), a stiffness `ea`
 * (N) and a submerged weight per length `w` (N/m). With `seabed` not 0 a flat bottom is at the anchor, of a `friction` coefficient each (null:
 * none). Results, each null where it is not wanted: pull on the fairlead toward the anchor `h` and downward `v`, pull on the anchor toward the
 * fairlead `anchor_h` and upward `anchor_v` (N), unstretched length on the bottom `grounded` (m), and the number of lines without an answer
 * `failed`, which are NaN. WINDLASS_REFUSED where there is one; windlass_last_error names the first. Each answer is proven to 1e-9 of the
 * fairlead tension. */
int windlass_catenary_solve(size_t count, const double *x, const double *z, const double *length, const double *ea, const double *w,
                            const double *friction, int seabed, double *h, double *v, double *anchor_h, double *anchor_v, double *grounded,
                            size_t *failed);

/* ---- Dynamic lines -------------------------------------------------------------------------------------------------------------------- */

/* Lines whose fairleads the caller moves. */
typedef struct windlass_dynamics windlass_dynamics;

/* A line: a rod with mass, stretch, drag and added mass, from its fairlead to its anchor, which stays. */
typedef struct windlass_line {
    double length;        /* unstretched (m) */
    double mass;          /* per length, in air (kg/m) */
    double ea;            /* axial stiffness (N) */
    double axial_damping; /* tension per strain rate (N s) */
    double ei;            /* bending stiffness (N m2); 0 of chains and ropes */
    double diameter;      /* that displaces, drags and lies on the bottom (m) */
    double cd_normal;
    double cd_axial; /* on the skin */
    double ca_normal;
    double ca_axial;
    size_t elements;
    double anchor[3];   /* x, y, z (m) */
    double fairlead[3]; /* x, y, z at time 0 (m) */
} windlass_line;

/* What surrounds lines. */
typedef struct windlass_surroundings {
    double density;          /* of the water (kg/m3) */
    double gravity;          /* (m/s2) */
    double current[3];       /* (m/s) */
    double depth;            /* of the flat bottom (m); NaN for none */
    double seabed_stiffness; /* (N/m3, on diameter times length) */
    double seabed_damping;   /* (N s/m3) */
    double friction;         /* Coulomb's coefficient */
    double longest_step;     /* (s): a call that goes further is cut in equal steps */
    const char *environment; /* options of an &ENV record in metres, seconds and degrees: waves by a spectrum and a seed
                              * ("-SEA JONSWAP 180 9 12 3.3 -SEED 5 -RAMP 60") or one by one ("-WAVES T A PHASE DIR .."), current by depth, wind.
                              * Its velocities come to `current`; lines feel the waves from time 0 on. Null for none */
} windlass_surroundings;

/* Lines at rest at time 0. Null where one is refused or finds no rest. */
windlass_dynamics *windlass_dynamics_new(const windlass_line *lines, size_t count, const windlass_surroundings *around);

/* Frees lines; null is left as it is. */
void windlass_dynamics_free(windlass_dynamics *lines);

/* Takes the lines to the time `t` (s), at which their fairleads are at `x` (m) and move at `v` (m/s), three numbers a line; the force of each on its
 * fairlead goes to `force` (N, three numbers a line; null where it is not wanted). A step that is refused leaves the lines as they were. */
int windlass_dynamics_step(windlass_dynamics *lines, double t, const double *x, const double *v, double *force);

/* The force of each line on its anchor (N, three numbers a line). */
int windlass_dynamics_anchor_forces(const windlass_dynamics *lines, double *force);

#ifdef __cplusplus
}
#endif

#endif

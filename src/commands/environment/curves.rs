//! `&DATA`: curves and environments, a curve in one record or many of either in a menu.
//!
//! Source: [MOSES-REF curv].

use crate::commands::menu;
use crate::commands::{Call, Command, Effect, Job, Menu};
use windlass_base::choices;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::values::Noun;
use windlass_connectors::viscous::ViscoelasticLaw;
use windlass_language::args;
use windlass_language::name as rule;
use windlass_language::record::Word;
use windlass_language::select::{Owner, choose, choose_word};
use windlass_language::spec::{CommandSpec, DatumKey, Kind, Opens, OptionSpec, TextForm, ValueSpec};
use windlass_model::{Curve, CurveKind, EntityKind, Model};

/// &DATA.
pub static DATA: Command = Command { spec: &SPEC, edits: false, run };

choices! {
    /// What `&DATA` defines.
    enum DataKind {
        Curves = "CURVES",
        Convolution = "CONVOLUTION",
        Environment = "ENVIRONMENT",
        Shapes = "SHAPES",
    }
}

static SPEC: CommandSpec = CommandSpec {
    form: TextForm::Text,
    opens: Opens::AtMost(&menu::CURVES, 1),
    data: &[ValueSpec::choice::<DataKind>("KIND", "what is defined")],
    detail: "&DATA CURVES TYPE NAME a1 b1 a2 b2 .. with TYPE C_PROFILE (depth, velocity), P_SPECTRUM (period, density), \
             F_SPECTRUM (frequency, density), M_GROWTH (elevation, added OD), W_HISTORY (time, knots), C_HISTORY (ours: time, factor of the current), S_HISTORY (ours: time, elevation of waves), LT_MULTIPLIER, \
             CT_LENGTH, EFFICIENCY, CS_VELOCITY or AM_PRESSURE; the first value grows. &DATA CURVES alone opens a menu of \
             such records, TYPE NAME a1 b1 .., up to END. &DATA CONVOLUTION TIME NAME t1 K1 .. or FREQUENCY NAME f1 K1 .. is the \
             stiffness of a viscoelastic spring, which -CONVOLUTION of a class puts in series: its force is the integral of \
             K(s) v(t - s) over s, v being the rate of its deflection. K of the first time is the \
             short-term, of the last the long-term stiffness, with which statics work; by frequency K is the stiffness in phase, \
             that of the first frequency the long-term one. -NDOF M behind either: the time domain works with M exponentials fitted \
             to the curve (least squares, none negative, times spaced on a log scale; at most one fewer than points), M 5 unless given; \
             &STATUS CURVES reports them and how far they are off. In RX, RY, RZ K is a moment per radian, in the same units. &DATA ENVIRONMENT opens a menu of ENV records up to END. \
             &DATA SHAPES opens a menu of sections of structural members, NAME TYPE A B .. -OPTIONS, as &HELP ~CLASS TYPE says of a type; ~C NAME is then a \
             class with that section. windlass ships no table of rolled shapes.",
    example: "&DATA CURVES C_PROFILE CUR 0 3.0 100 2.0 500 0.5\n&DATA CURVES\nM_GROWTH MG -100 0 0 2\nEND\n&STATUS CURVES CUR\n&DATA SHAPES\nW14X140 IBEAM 14.4 15.5 0.7 1.1 -SECTION 41.2\nEND_&DATA\n\
              MEDIT\n~G W14X140\nEND\n&STATUS CLASS ~G",
    ..CommandSpec::new("&DATA", "defines curves, environments and shapes")
};

const fn curve(name: &'static str, help: &'static str, example: &'static str) -> CommandSpec {
    CommandSpec {
        menus: const { &[&menu::CURVES] },
        repeat: 2,
        detail: "At least two pairs, the first value growing from pair to pair. A name given again is redefined.",
        example,
        ..CommandSpec::new(name, help)
    }
}

/// The data of a curve's record: its name, then pairs.
const fn pairs(kind: CurveKind) -> [ValueSpec; 3] {
    let [(first, of_first), (second, of_second)] = kind.axes();
    let grows = ValueSpec::new(first, Kind::Number(of_first), "grows from pair to pair");
    let value = ValueSpec::new(second, Kind::Number(of_second), "value there");
    let name = ValueSpec::new("NAME", Kind::Name(Noun::New), "name of the curve");
    match kind {
        // a spectrum has energy at real waves only
        CurveKind::PeriodSpectrum | CurveKind::FrequencySpectrum => [name, grows.not_negative(), value.not_negative()],
        // a relaxation begins at time zero
        CurveKind::ConvolutionTime | CurveKind::ConvolutionFrequency => [name, grows.not_negative(), value.positive()],
        _ => [name, grows, value],
    }
}

/// C_PROFILE within `&DATA CURVES`.
pub static C_PROFILE: Command = Command {
    spec: &CommandSpec {
        data: &pairs(CurveKind::CurrentProfile),
        ..curve(
            "C_PROFILE",
            "current: depth below the surface and velocity",
            "&DATA CURVES\nC_PROFILE CUR 0 3.0 100 2.0 500 0.5\nEND",
        )
    },
    edits: false,
    run: |job, call| define(job, call, CurveKind::CurrentProfile),
};
/// P_SPECTRUM within `&DATA CURVES`.
pub static P_SPECTRUM: Command = Command {
    spec: &CommandSpec {
        data: &pairs(CurveKind::PeriodSpectrum),
        ..curve("P_SPECTRUM", "wave or wind spectrum by period", "&DATA CURVES\nP_SPECTRUM SWELL 5 0 11 25 20 0\nEND")
    },
    edits: false,
    run: |job, call| define(job, call, CurveKind::PeriodSpectrum),
};
/// F_SPECTRUM within `&DATA CURVES`.
pub static F_SPECTRUM: Command = Command {
    spec: &CommandSpec {
        data: &pairs(CurveKind::FrequencySpectrum),
        ..curve(
            "F_SPECTRUM",
            "wave or wind spectrum by frequency",
            "&DATA CURVES\nF_SPECTRUM WAVES 0.3 0 0.6 25 1.2 0\nEND",
        )
    },
    edits: false,
    run: |job, call| define(job, call, CurveKind::FrequencySpectrum),
};
/// M_GROWTH within `&DATA CURVES`.
pub static M_GROWTH: Command = Command {
    spec: &CommandSpec {
        data: &pairs(CurveKind::MarineGrowth),
        ..curve(
            "M_GROWTH",
            "marine growth: elevation and added diameter",
            "&DATA CURVES\nM_GROWTH GROW -100 0 -50 1 0 2\nEND",
        )
    },
    edits: false,
    run: |job, call| define(job, call, CurveKind::MarineGrowth),
};
/// W_HISTORY within `&DATA CURVES`.
pub static W_HISTORY: Command = Command {
    spec: &CommandSpec {
        data: &pairs(CurveKind::WindHistory),
        ..curve("W_HISTORY", "wind: time and speed", "&DATA CURVES\nW_HISTORY BLOW 0 20 60 35 120 25\nEND")
    },
    edits: false,
    run: |job, call| define(job, call, CurveKind::WindHistory),
};
/// C_HISTORY within `&DATA CURVES`.
pub static C_HISTORY: Command = Command {
    spec: &CommandSpec {
        data: &pairs(CurveKind::CurrentHistory),
        owner: Owner::Ours,
        ..curve("C_HISTORY", "current: time and factor", "&DATA CURVES\nC_HISTORY TURN 0 1 3600 0.2\nEND")
    },
    edits: false,
    run: |job, call| define(job, call, CurveKind::CurrentHistory),
};
/// S_HISTORY within `&DATA CURVES`.
pub static S_HISTORY: Command = Command {
    spec: &CommandSpec {
        data: &pairs(CurveKind::ElevationHistory),
        owner: Owner::Ours,
        ..curve(
            "S_HISTORY",
            "waves: time and elevation at X = Y = 0, at even steps",
            "&DATA CURVES\nS_HISTORY SWELL 0 0 2 1.2 4 1.9 6 1.2 8 0 10 -1.2 12 -1.9 14 -1.2\nEND",
        )
    },
    edits: false,
    run: |job, call| define(job, call, CurveKind::ElevationHistory),
};
/// LT_MULTIPLIER within `&DATA CURVES`.
pub static LT_MULTIPLIER: Command = Command {
    spec: &CommandSpec {
        data: &pairs(CurveKind::LoadMultiplier),
        ..curve(
            "LT_MULTIPLIER",
            "multiplier of a load: time and factor",
            "&DATA CURVES\nLT_MULTIPLIER RISE 0 0 60 1\nEND",
        )
    },
    edits: false,
    run: |job, call| define(job, call, CurveKind::LoadMultiplier),
};
/// CT_LENGTH within `&DATA CURVES`.
pub static CT_LENGTH: Command = Command {
    spec: &CommandSpec {
        data: &pairs(CurveKind::ConnectorLength),
        ..curve(
            "CT_LENGTH",
            "change of a connector's length: time and length",
            "&DATA CURVES\nCT_LENGTH HAUL 0 0 600 -50\nEND",
        )
    },
    edits: false,
    run: |job, call| define(job, call, CurveKind::ConnectorLength),
};
/// EFFICIENCY within `&DATA CURVES`.
pub static EFFICIENCY: Command = Command {
    spec: &CommandSpec {
        data: &pairs(CurveKind::Efficiency),
        ..curve("EFFICIENCY", "efficiency: velocity and factor", "&DATA CURVES\nEFFICIENCY PROP 0 1 10 0.6\nEND")
    },
    edits: false,
    run: |job, call| define(job, call, CurveKind::Efficiency),
};
/// CS_VELOCITY within `&DATA CURVES`.
pub static CS_VELOCITY: Command = Command {
    spec: &CommandSpec {
        data: &pairs(CurveKind::DragVelocity),
        ..curve(
            "CS_VELOCITY",
            "multiplier of drag: velocity and factor",
            "&DATA CURVES\nCS_VELOCITY DRAG 0 1.2 5 0.7\nEND",
        )
    },
    edits: false,
    run: |job, call| define(job, call, CurveKind::DragVelocity),
};
/// AM_PRESSURE within `&DATA CURVES`.
pub static AM_PRESSURE: Command = Command {
    spec: &CommandSpec {
        data: &pairs(CurveKind::AddedMassPressure),
        ..curve(
            "AM_PRESSURE",
            "multiplier of added-mass pressure: elevation and factor",
            "&DATA CURVES\nAM_PRESSURE PRES -30 1 0 0.5\nEND",
        )
    },
    edits: false,
    run: |job, call| define(job, call, CurveKind::AddedMassPressure),
};

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let form = "form: &DATA CURVES [TYPE NAME a1 b1 a2 b2 ..], &DATA CONVOLUTION TIME NAME t1 K1 .., &DATA ENVIRONMENT or &DATA SHAPES";
    let Some(kind) = call.words.get(1) else {
        return Err(Diagnostic::error("&DATA lacks what it defines", call.record.whole()).help(form));
    };
    let words = call.words.get(2..).unwrap_or_default();
    match choose_word(&kind.text, kind.span, "kind of &DATA")? {
        DataKind::Environment => {
            job.menus.push(Menu::Environments);
            return Ok(Effect::Done);
        }
        DataKind::Shapes => {
            job.menus.push(Menu::Shapes);
            return Ok(Effect::Done);
        }
        DataKind::Convolution => return convolution(job, call, kind.span, words),
        DataKind::Curves => {}
    }
    let Some((kind, values)) = words.split_first() else {
        job.menus.push(Menu::Curves);
        return Ok(Effect::Done);
    };
    // one curve in one record: read as the menu's record is
    let kinds = crate::commands::commands_of_menu(&menu::CURVES)
        .filter(|c| !c.spec.menus.is_empty())
        .map(|c| (c.spec.name, c.spec.owner, c));
    let command = choose(&kind.text, kind.span, "type of curve", kinds)?;
    let args = args::read(command.spec, kind.span, values, job.units)?;
    (command.run)(job, &Call { record: call.record, words, args })
}

/// Exponentials where `-NDOF` says nothing.
const DEFAULT_EXPONENTIALS: i64 = 5;

const NDOF_OPTION: OptionSpec = OptionSpec::new(
    "-NDOF",
    &[ValueSpec::new("M", Kind::Integer, "number of exponentials").in_range(1.0, 20.0)],
    "exponentials fitted to the curve",
)
.default("5");

const NDOF: &[OptionSpec] = &[NDOF_OPTION];

static BY_TIME: CommandSpec = CommandSpec {
    data: &pairs(CurveKind::ConvolutionTime),
    repeat: 2,
    options: NDOF,
    ..CommandSpec::new("&DATA CONVOLUTION TIME", "viscoelastic spring by time")
};

static BY_FREQUENCY: CommandSpec = CommandSpec {
    data: &pairs(CurveKind::ConvolutionFrequency),
    repeat: 2,
    options: NDOF,
    ..CommandSpec::new("&DATA CONVOLUTION FREQUENCY", "viscoelastic spring by frequency")
};

fn convolution(job: &mut Job, call: &Call, span: Span, words: &[Word]) -> Outcome<Effect> {
    let Some((of, values)) = words.split_first() else {
        return Err(Diagnostic::error("&DATA CONVOLUTION lacks TIME or FREQUENCY", span)
            .help("form: &DATA CONVOLUTION TIME NAME t1 K1 t2 K2 .."));
    };
    let kinds = [("TIME", CurveKind::ConvolutionTime), ("FREQUENCY", CurveKind::ConvolutionFrequency)];
    let names = kinds.into_iter().map(|(name, kind)| (name, Owner::Moses, kind));
    let kind = choose(&of.text, of.span, "convolution", names)?;
    let spec = if kind == CurveKind::ConvolutionTime { &BY_TIME } else { &BY_FREQUENCY };
    let args = args::read(spec, of.span, values, job.units)?;
    define(job, &Call { record: call.record, words, args }, kind)
}

/// Share of the largest stiffness above which a fit is warned of.
const POOR_FIT_SHARE: f64 = 0.05;

fn define(job: &mut Job, call: &Call, kind: CurveKind) -> Outcome<Effect> {
    let args = &call.args;
    // the data of every curve begin so
    const NAME: DatumKey<str> = BY_TIME.word("NAME");
    let (name, span) = (args.word(NAME).unwrap_or_default(), args.position(NAME));
    rule::check(name, None, "curve", span)?;
    job.model.free_name(name, &[EntityKind::Curve], span)?;
    let [(first, _), _] = kind.axes();
    let mut points: Vec<(f64, f64)> = Vec::new();
    for pair in args.data_after(NAME).chunks_exact(2) {
        let [a, b] = pair else { continue };
        let point = (a.number().unwrap_or_default(), b.number().unwrap_or_default());
        if points.last().is_some_and(|last| point.0 <= last.0) {
            return Err(Diagnostic::error(format!("{first} of a curve must grow from point to point"), a.span)
                .label("not larger than the one before"));
        }
        points.push(point);
    }
    if points.len() < 2 {
        return Err(Diagnostic::error("a curve has at least two points", span));
    }
    let exponentials =
        args.option_if_declared(&NDOF_OPTION).and_then(|g| g.values.first()?.integer()).unwrap_or(DEFAULT_EXPONENTIALS);
    let exponentials = usize::try_from(exponentials).unwrap_or(1);
    let made = Curve { name: name.to_string(), kind, points, exponentials, metres: job.units.metres(), span };
    if let Some(fit) = ViscoelasticLaw::fit(&made).filter(|fit| fit.error > POOR_FIT_SHARE) {
        let text = format!(
            "the exponentials of curve {name} are off by {:.0} per cent of its largest stiffness",
            100.0 * fit.error
        );
        job.warn(text, span);
    }
    if job.model.curves.insert(Model::key(name), made).is_some() {
        job.remark(format!("curve {name} is redefined"), span);
    }
    Ok(Effect::Done)
}

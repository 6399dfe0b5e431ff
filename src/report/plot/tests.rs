use super::*;
use proptest::prelude::*;
use windlass_base::table::Digits;

fn chart() -> Chart {
    let xs: Vec<f64> = (0..30).map(f64::from).collect();
    let t = Table::new("Line A")
        .with_rows(&xs)
        .column("", "X", Dim::Length, Digits::Usual, |x| *x)
        .column("", "Force", Dim::Force, Digits::Usual, |x| (*x != 10.0).then_some(x * x))
        .build();
    Chart::from_table(&t, UnitSystem::SI).unwrap()
}

#[test]
fn every_surface_shows_title_axes_and_units_reproducibly() {
    let svg = String::from_utf8(chart().svg().unwrap()).unwrap();
    for text in ["Line A", "X (m)", "Force (N)", "<polyline"] {
        assert!(svg.contains(text), "{text} is missing from the SVG");
    }
    let screen = chart().terminal(80, 24).unwrap();
    for text in ["Line A", "X (m)", "Force (N)"] {
        assert!(screen.contains(text), "{text} is missing from\n{screen}");
    }
    assert_eq!(chart().png().unwrap(), chart().png().unwrap());
    assert!(chart().png().unwrap().starts_with(b"\x89PNG"));
}

#[test]
fn no_finite_points_is_error_and_one_point_is_not() {
    let series = |points| Chart { series: vec![PlotSeries { points, ..PlotSeries::default() }], ..Chart::default() };
    assert_eq!(series(vec![None]).svg(), Err(PlotError::Empty));
    assert_eq!(series(vec![Some((f64::NAN, 1.0)), Some((0.0, f64::INFINITY))]).png(), Err(PlotError::Empty));
    assert_eq!(series(vec![Some((0.0, 1e300))]).svg(), Err(PlotError::Range(0.0, 1e300)));
    assert!(series(vec![Some((1.0, 2.0))]).terminal(60, 15).is_ok());
}

#[test]
fn missing_point_breaks_curve_and_many_points_have_no_markers() {
    let count = |chart: &Chart, what: &str| {
        let svg = String::from_utf8(chart.svg().unwrap()).unwrap();
        svg.matches(what).count()
    };
    let broken = chart();
    let mut whole = broken.clone();
    whole.series[0].points[10] = Some((10.0, 100.0));
    assert_eq!(count(&broken, "<circle"), 29);
    assert_eq!(count(&whole, "<circle"), 30);
    assert_eq!(count(&broken, "stroke=\"#0072B2\""), count(&whole, "stroke=\"#0072B2\"") + 1);
    whole.series[0].points = (0..100).map(|n| Some((f64::from(n), 0.0))).collect();
    assert_eq!(count(&whole, "<circle"), 0);
}

#[test]
fn isolated_points_are_markers_without_connecting_lines() {
    let line =
        PlotSeries { name: "Z".into(), points: (0..9).map(|n| Some((f64::from(n), 1.0))).collect(), right: false };
    let at = |rows: &[usize]| {
        let point = |n: usize| rows.contains(&n).then_some((n as f64, 1.0));
        PlotSeries { name: "Joint".into(), points: (0..9).map(point).collect(), right: false }
    };
    let chart = |series| Chart { series, ..Chart::default() };
    // a gap, then a point by itself within a line, then marks that stand before the line among the columns
    let mut broken = line.clone();
    broken.points[4] = None;
    broken.points[6] = None;
    for (series, large, small) in [
        (vec![line.clone(), at(&[2, 5])], 3, 0),
        (vec![at(&[2, 5]), line.clone()], 3, 0),
        (vec![broken.clone(), at(&[2])], 2, 1),
        (vec![line.clone(), broken], 0, 18),
    ] {
        let marks: Vec<(usize, usize)> = series
            .iter()
            .enumerate()
            .filter(|(_, s)| s.name == "Joint")
            .map(|(i, s)| (i, s.finite().count()))
            .collect();
        let drawn = chart(series);
        let svg = String::from_utf8(drawn.svg().unwrap()).unwrap();
        let circles = |radius: &str| svg.matches(&format!("r=\"{radius}\"")).count();
        assert_eq!((circles("60"), circles("30")), (large, small), "{svg}");
        let screen = drawn.terminal(60, 16).unwrap();
        let plot: String = screen.lines().take(14).collect();
        for (index, count) in marks {
            assert_eq!(plot.matches(terminal::mark(index)).count(), count, "{screen}");
        }
        let whole =
            Chart { series: drawn.series.iter().filter(|s| s.name != "Joint").cloned().collect(), ..drawn.clone() };
        assert_eq!(drawn.png().unwrap() != whole.png().unwrap(), large > 0);
    }
}

#[test]
fn second_unit_has_right_axis_and_legend_names_axes() {
    let t = Table::new("t")
        .with_rows(&[(1.0, 2.0, 3.0), (2.0, 3.0, 2.0)])
        .column("", "X", Dim::Length, Digits::Usual, |row| row.0)
        .column("", "Force", Dim::Force, Digits::Usual, |row| row.1)
        .column("", "On Bottom", Dim::Length, Digits::Usual, |row| row.2)
        .build();
    let chart = Chart::from_table(&t, UnitSystem::SI).unwrap();
    assert_eq!((chart.y_label.as_str(), chart.right_label.as_deref()), ("Force (N)", Some("On Bottom (m)")));
    let svg = String::from_utf8(chart.svg().unwrap()).unwrap();
    let screen = chart.terminal(60, 16).unwrap();
    assert!(["Force", "On Bottom"].iter().all(|n| svg.contains(n) && screen.contains(n)), "{screen}");
    assert_eq!(screen.lines().count(), 18);
    for lines in [10, 16, 24, 41] {
        let screen = chart.terminal(72, lines).unwrap();
        let last: Vec<&str> = screen.lines().skip(lines - 2).take(1).flat_map(str::split_whitespace).collect();
        assert!(last.contains(&"1.0") && last.contains(&"2.0"), "no labels under the axis of\n{screen}");
    }
    assert!(screen.lines().all(|l| l.chars().count() <= 60 && l == l.trim_end()), "{screen}");
}

#[test]
fn third_unit_is_refused_and_one_unit_may_use_both_axes() {
    let dims = [("X", Dim::Length), ("F", Dim::Force), ("G", Dim::Force), ("L", Dim::Length), ("T", Dim::Time)];
    let column =
        |(n, (name, dim)): (usize, (&str, Dim))| Column::new("", name, dim, Digits::Usual, [n as f64, (n * n) as f64]);
    let t = Table::from_columns("t", dims.into_iter().enumerate().map(column).collect());
    let taken = |list: &[usize]| Table::from_columns("t", list.iter().map(|n| t.columns()[*n].clone()).collect());
    let refused = Err(PlotError::Units("L (m), T (s)".into()));
    assert_eq!(Chart::from_table(&t, UnitSystem::SI), refused);
    assert_eq!(Chart::with_right(&taken(&[0, 1, 2]), &[2], UnitSystem::SI).unwrap().right_label.unwrap(), "G (N)");
    let mixed = Chart::with_right(&taken(&[0, 1, 2, 3]), &[2], UnitSystem::SI);
    assert_eq!(mixed, Err(PlotError::Units("F (N), L (m)".into())));
    assert_eq!(Chart::with_right(&taken(&[0, 1]), &[1], UnitSystem::SI), Err(PlotError::NoLeft));
}

#[test]
fn curve_on_right_axis_fills_plot_like_one_on_left() {
    // both rise over their whole axis: drawn by axes of their own they are one line
    let rise = |size: f64, right: bool| PlotSeries {
        name: String::new(),
        points: (0..3).map(|n| Some((f64::from(n), size * f64::from(n)))).collect(),
        right,
    };
    let series = vec![rise(1.0, false), rise(1e6, true)];
    let chart = Chart { series, right_label: Some("N".into()), ..Chart::default() };
    let svg = String::from_utf8(chart.svg().unwrap()).unwrap();
    let lines = |colour: &str| -> Vec<String> {
        let wide = format!("stroke=\"{colour}\" stroke-width=\"20\"");
        svg.lines().filter(|l| l.contains(&wide) && l.contains("polyline")).map(|l| l.replace(colour, "")).collect()
    };
    assert_eq!(lines("#0072B2").first(), lines("#D55E00").first());
    assert!(!lines("#0072B2").is_empty() && svg.contains("1000000"), "{svg}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]
    #[test]
    fn any_points_are_plotted_or_refused(
        points in prop::collection::vec(prop::option::of((any::<f64>(), any::<f64>())), 0..6),
        columns in 0usize..250,
        lines in 0usize..60,
    ) {
        let series = vec![
            PlotSeries { name: "a".into(), points: points.clone(), right: false },
            PlotSeries { name: "b".into(), points, right: columns % 2 == 1 },
        ];
        let title = "\u{1b}t".to_string();
        for polar in [false, true] {
            let (series, title) = (series.clone(), title.clone());
            let right_label = (columns % 2 == 1 && !polar).then(String::new);
            let chart = Chart { title, series, polar, right_label, ..Chart::default() };
            let drawn = chart.terminal(columns, lines);
            prop_assert_eq!(drawn.is_ok(), chart.svg().is_ok());
        }
    }
}

use super::*;
use windlass_base::units::METRES_PER_FOOT;

fn menu() -> Disposition {
    let t = Table::new("t")
        .with_rows(&[1.0, 2.0, 3.0, 4.0, 5.0])
        .column("", "X", Dim::Length, Digits::Usual, |n| n * METRES_PER_FOOT)
        .column("", "F", Dim::None, Digits::Usual, |n| n * n)
        .build();
    Disposition::new(t)
}

fn with_missing_cell(table: &Table, column: usize, row: usize) -> Table {
    let mut columns = table.columns().to_vec();
    columns[column].cells[row] = Cell::Missing;
    table.clone().with_columns(columns)
}

#[test]
fn scale_and_shift_act_on_views_in_user_units_but_not_on_table() {
    let mut d = menu();
    let us = UnitSystem::default();
    d.scale(10.0, &["X"]).unwrap();
    d.shift(-1.0, &["1"]).unwrap();
    let text = d.values("X", &RowChoice::default(), us).unwrap();
    let values: Vec<f64> = text.split(' ').map(|v| v.parse().unwrap()).collect();
    // feet to metres and back rounds once each way
    assert!(values.iter().zip([9.0, 19.0, 29.0, 39.0, 49.0]).all(|(a, b)| (a - b).abs() < 1e-13 * b), "{text}");
    assert_eq!(d.table.columns()[0].cells[0], Cell::Number(METRES_PER_FOOT));
}

#[test]
fn rows_are_chosen_by_number_and_by_value() {
    let d = menu();
    let us = UnitSystem::default();
    let by_number = RowChoice { record: Some((2, 3)), ..RowChoice::default() };
    assert_eq!(d.values("F", &by_number, us).unwrap(), "4 9");
    let by_value = RowChoice { values: Some(("X".into(), 3.5, 9.0)), ..RowChoice::default() };
    assert_eq!(d.values("F", &by_value, us).unwrap(), "16 25");
    let none = RowChoice { record: Some((9, 12)), ..RowChoice::default() };
    assert!(d.values("F", &none, us).unwrap_err().to_string().contains("not times"));
}

#[test]
fn column_chosen_twice_is_scaled_once_and_listed() {
    let mut d = menu();
    d.scale(10.0, &["X", "1:2"]).unwrap();
    d.shift(1.0, &["F", "F"]).unwrap();
    let us = UnitSystem::default();
    assert_eq!(
        d.values("F", &RowChoice { record: Some((2, 2)), values: None, from: None, events: None }, us).unwrap(),
        "41"
    );
    let list = d.vlist(us);
    assert!(list[0].ends_with("10.00 to 50.00") && list[1].ends_with("11.0000 to 251.0000"), "{list:?}");
}

#[test]
fn culled_rows_keep_values_and_earlier_scales_and_shifts() {
    let mut d = menu();
    let us = UnitSystem::default();
    d.scale(2.0, &["F"]).unwrap();
    d.shift(-1.0, &["F", "X"]).unwrap();
    // F shows 2 n n - 1: rows 2 and 3 show 7 and 17
    let mut culled = d.cull("F", &[(0.0, 6.9), (17.1, 1e9)], us).unwrap();
    assert_eq!(culled.table.columns()[1].cells, [Cell::Number(4.0), Cell::Number(9.0)]);
    let kept = RowChoice { record: Some((2, 3)), values: None, from: None, events: None };
    for column in [0, 1] {
        let before = d.extract(&[column], &kept, true, us).unwrap();
        assert_eq!(culled.extract(&[column], &RowChoice::default(), true, us).unwrap(), before);
    }
    culled.shift(1.0, &["F"]).unwrap();
    assert_eq!(culled.values("F", &RowChoice::default(), us).unwrap(), "8 18");
    assert_eq!(d.values("F", &kept, us).unwrap(), "7 17");
}

#[test]
fn cull_excludes_closed_ranges_in_user_units() {
    let mut d = menu();
    d.table = with_missing_cell(&d.table, 1, 2);
    let us = UnitSystem::default();
    let kept = |column: &str, ranges: &[(f64, f64)]| {
        let rows = d.cull(column, ranges, us).map(|c| c.table.columns()[0].clone());
        rows.map(|c| c.numbers().iter().map(|x| (x / METRES_PER_FOOT).round() as i32).collect::<Vec<_>>())
    };
    assert_eq!(kept("X", &[(2.0, 3.0), (4.5, 9.0)]), Ok(vec![1, 4]));
    assert_eq!(kept("1", &[(1.5, 3.5), (0.0, 1.0)]), Ok(vec![4, 5]));
    assert_eq!(kept("X", &[(2.1, 2.9)]), Ok(vec![1, 2, 3, 4, 5]));
    // a cell without a value lies inside of no range
    assert_eq!(kept("F", &[(-1e9, 20.0)]), Ok(vec![3, 5]));
    assert_eq!(kept("X", &[(0.0, 1e9)]), Err(DispositionError::AllCulled("X".into())));
    assert_eq!(kept("1:2", &[(0.0, 1.0)]), Err(DispositionError::NotOne { selector: "1:2".into(), count: 2 }));
}

#[test]
fn range_ends_survive_unit_conversion() {
    let us = UnitSystem::default();
    let lengths: Vec<f64> = (1..=2000).map(|n| Dim::Length.to_si(f64::from(n) * 0.1, us)).collect();
    let t = Table::new("t").with_rows(&lengths).column("", "X", Dim::Length, Digits::Usual, |x| *x).build();
    let d = Disposition::new(t);
    for n in 1..=2000 {
        let at: f64 = format!("{}.{}", n / 10, n % 10).parse().unwrap();
        assert_eq!(d.cull("X", &[(at, at)], us).unwrap().table.rows(), 1999, "{at}");
        let only = RowChoice { values: Some(("X".into(), at, at)), ..RowChoice::default() };
        assert_eq!(d.rows(&only, us).unwrap().len(), 1, "{at}");
    }
}

#[test]
fn culled_table_notes_state_once_they_cover_the_whole_table() {
    let mut d = menu();
    d.table.note("row 5 is beyond the breaking tension");
    let us = UnitSystem::default();
    let notes = |d: &Disposition| d.table.notes.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ");
    assert_eq!(notes(&d.cull("X", &[(8.0, 9.0)], us).unwrap()), "row 5 is beyond the breaking tension");
    let once = d.cull("X", &[(1.0, 1.0)], us).unwrap();
    let want = "of the whole table, by its row numbers before CULL:; row 5 is beyond the breaking tension";
    assert_eq!(notes(&once), want);
    assert_eq!(notes(&once.cull("X", &[(2.0, 2.0)], us).unwrap()), want);
}

#[test]
fn missing_value_is_reported_not_skipped() {
    let mut d = menu();
    d.table = with_missing_cell(&d.table, 1, 2);
    let us = UnitSystem::default();
    let from_two = RowChoice { record: Some((2, 5)), values: None, from: None, events: None };
    let want = DispositionError::NoValue { column: "F".into(), row: 3 };
    assert_eq!(d.values("F", &from_two, us), Err(want));
    assert_eq!(
        d.values("F", &RowChoice { record: Some((4, 5)), values: None, from: None, events: None }, us).unwrap(),
        "16 25"
    );
}

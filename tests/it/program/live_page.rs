//! `--page`: a page of the job that is written as it goes.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

const SCRIPT: &str = "&DIMEN -DIMEN METERS K-NTS\nMEDIT\n&DESCRIBE BODY SEMI -IGNORE Z RX RY RZ\n*CG 0 0 0\n#WEIGHT *CG 30000 20 20 20\n\
                      ~W B_CAT 100 -LEN 700 -DEP 150\nCONNECTOR BOW -ANC 0 650 ~W *CG\nCONNECTOR PORT -ANC 120 650 ~W *CG\n\
                      CONNECTOR STB -ANC -120 650 ~W *CG\nEND\n&EQUI\n&INSTATE -LOCATE SEMI 5 3\n&ENV -TIME 5 0.5\nTDOM\n";

fn windlass(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_windlass")).args(arguments).current_dir(folder).output().unwrap()
}

#[test]
fn page_holds_lines_tables_and_curves_of_the_job() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("job.cif"), SCRIPT).unwrap();
    let run = windlass(folder.path(), &["run", "job.cif", "--page", "live.html"]);
    assert_eq!(run.status.code(), Some(0), "{}", String::from_utf8_lossy(&run.stderr));
    let page = fs::read_to_string(folder.path().join("live.html")).unwrap();
    let data = page.split("id=\"data\">").nth(1).unwrap().split("</script>").next().unwrap();
    let data: serde_json::Value = serde_json::from_str(data).unwrap();
    assert_eq!((data["state"].as_str(), data["title"].as_str()), (Some("the job is done"), Some("job")));
    let names = |of: &str| -> Vec<String> {
        let list = data["scene"][of].as_array().unwrap().iter();
        list.map(|one| one["name"].as_str().unwrap().to_string()).collect()
    };
    assert_eq!(
        (names("paths"), names("bodies")),
        (vec!["BOW".into(), "PORT".into(), "STB".into()], vec!["SEMI".into()])
    );
    // the anchor of BOW lies 650 m ahead, in 150 m of water
    let points = data["scene"]["paths"][0]["points"].as_array().unwrap();
    let end = points.last().unwrap().as_array().unwrap();
    let far = |i: usize| end[i].as_f64().unwrap();
    assert!((far(0) - 650.0).abs() < 1e-6 && (far(2) + 150.0).abs() < 1e-6, "{end:?}");
    let titles: Vec<&str> = data["tables"].as_array().unwrap().iter().filter_map(|t| t["title"].as_str()).collect();
    assert!(titles.contains(&"Time Domain") && titles.contains(&"Tensions at First Ends"), "{titles:?}");
    // three tensions, and three places of the body
    assert_eq!(data["curves"].as_array().unwrap().len(), 6);
    let left: Vec<_> = fs::read_dir(folder.path()).unwrap().flatten().map(|e| e.file_name()).collect();
    assert!(left.iter().all(|name| !name.to_string_lossy().ends_with(".part")), "{left:?}");
    // the page of an earlier job is taken over
    assert_eq!(windlass(folder.path(), &["run", "job.cif", "--page", "live.html"]).status.code(), Some(0));
}

#[test]
fn page_that_cannot_be_written_is_refused_before_the_job_and_loses_nothing() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("job.cif"), SCRIPT).unwrap();
    fs::write(folder.path().join("mine.html"), "<p>mine</p>").unwrap();
    for (name, what) in [
        ("nowhere/live.html", "cannot be written"),
        ("mine.html", "is no page of windlass"),
        ("live.txt", "a page ends in .html"),
    ] {
        let run = windlass(folder.path(), &["run", "job.cif", "--page", name]);
        let said = String::from_utf8_lossy(&run.stderr).into_owned();
        assert!(run.status.code() == Some(2) && said.contains(what), "{name}: {said}");
        assert!(run.stdout.is_empty());
    }
    assert_eq!(fs::read_to_string(folder.path().join("mine.html")).unwrap(), "<p>mine</p>");
}

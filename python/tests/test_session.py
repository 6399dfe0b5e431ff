"""Sessions: numbers of the catenary through records, errors with their place, warnings, interruption, drawings, the cell magic."""

import _thread
import pickle
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import windlass

CHAIN = """\
&DIMEN -DIMEN METERS K-NTS
&ENV -DEPTH 100
MEDIT
&DESCRIBE BODY BUOY -IGNORE Z RX RY RZ
*CG 0 0 0
*F 0 0 0
#WEIGHT *CG 100 2 2 2
~W B_CAT 100 -LEN 300 -WTPLEN 1 -EMODULUS 1E12 -BUOYDIAMETER 0 -DEPANCHOR 100
CONNECTOR A -ANC 0 250 ~W *F
END
"""


@pytest.fixture
def w(tmp_path):
    return windlass.Session(tmp_path / "job")


@pytest.fixture
def chain(w):
    w.run(CHAIN)
    return w


@pytest.fixture
def table(chain):
    chain.run("CONN_DESIGN\nTABLE A\nEND\nEND")
    return chain.table()


def test_table_of_a_line_has_the_numbers_of_the_catenary(table):
    assert table.title == "Properties of Line A"
    assert (table.units["Ten Top"], table.units["Force"], table.units["Crit. Seg"]) == ("kN", "kN", "")
    grounded = table["Line on Bottom"] > 0
    h, tension = table["Force"][grounded], table["Ten Top"][grounded]
    # T = H + w z of an inextensible line on a bottom
    assert grounded.sum() > 5 and np.allclose(tension, h + 100.0, rtol=1e-6)
    assert np.allclose(table["Line on Bottom"][grounded], 300 - np.sqrt(100**2 + 200 * h), atol=1e-3)
    si = table.in_si()
    assert si.units["Ten Top"] == "N" and np.allclose(si["Ten Top"], 1000 * table["Ten Top"], rtol=1e-12)
    assert table["Ten Top (kN)"] is not None and "Ten Top" in table and "Nothing" not in table
    assert table.row(0)["Ten Top"] == table["Ten Top"][0] and table.row(-1) == table.row(len(table) - 1)


def test_si_has_radians():
    session = windlass.Session()
    session.run(
        "&DIMEN -DIMEN METERS K-NTS\nMEDIT\n&DESCRIBE BODY B -IGNORE X Y Z RX RY RZ\n*CG 0 0 0\n#WEIGHT *CG 100 2 2 2\nEND\n"
        "&INSTATE -LOCATE B 0 0 0 0 0 30\n&STATUS CONFIGURATION\n"
    )
    table = session.table()
    si = table.in_si()
    assert (table.units["Yaw"], table["Yaw"][0]) == ("deg", pytest.approx(30.0))
    assert (si.units["Yaw"], si["Yaw"][0]) == ("rad", pytest.approx(np.pi / 6))


def test_unknown_column_row_and_title_name_the_near_ones(chain, table):
    with pytest.raises(KeyError, match="did you mean Ten Top"):
        table["Ten Tpo"]
    with pytest.raises(IndexError, match="has 30"):
        table.row(30)
    assert chain.table("properties of line a").title == table.title
    assert chain.table("Line A").title == table.title
    with pytest.raises(KeyError, match="Properties"):
        chain.table("Properties of Line B")
    with pytest.raises(windlass.Error, match="no record has shown a table"):
        windlass.Session().table()


def test_pandas_polars_and_pyarrow_take_the_table(table):
    pandas = pytest.importorskip("pandas")
    frame = table.to_pandas()
    assert list(frame.columns) == table.names and len(frame) == len(table)
    assert frame.attrs["units"]["Ten Top"] == "kN" and frame.attrs["title"] == table.title
    assert "Ten Top (kN)" in table.to_pandas(with_units=True).columns
    assert np.array_equal(frame["Ten Top"].to_numpy(), table["Ten Top"])
    arrow = pytest.importorskip("pyarrow").table(table)
    assert arrow.column_names == table.names and arrow.num_rows == len(table)
    assert arrow.schema.field("Ten Top").metadata[b"unit"] == b"kN"
    assert np.array_equal(arrow["Ten Top"].to_numpy(), table["Ten Top"])
    polars = pytest.importorskip("polars")
    taken = polars.DataFrame(table)
    assert taken.columns == table.names and taken["Ten Top"].to_list() == list(table["Ten Top"])
    assert isinstance(frame, pandas.DataFrame)


def test_columns_of_text_and_missing_cells(chain):
    chain.run("&STATUS F_CONNECTOR")
    table = chain.table()
    assert table["Name"].dtype == object and table["Name"].tolist() == ["A"]
    arrow = pytest.importorskip("pyarrow").table(table)
    assert arrow["Name"].to_pylist() == ["A"]


def test_refused_record_is_an_exception_with_its_place(w):
    with pytest.raises(windlass.RecordError) as caught:
        w.run("&DIMEN -DIMEN METERS K-NTS\n&ENV -DEPTH deep\n&SET A = 1", name="cell 7")
    error = caught.value
    assert (error.line, error.column, error.word, error.source) == (2, 13, "deep", "cell 7")
    assert "^^^^" in str(error) and "cell 7:2:13" in str(error) and "&ENV -DEPTH deep" in str(error)
    assert error.message and "\n" not in error.message
    assert w.variable("A") is None and "Meters" in w.units
    assert pickle.loads(pickle.dumps(error)).line == 2
    w.run("&SET A = 2")
    assert w.variable("A") == "2"


def test_any_text_is_an_answer_or_an_exception(w):
    for text in ["", "\0\0", "((((", "&SET X = %(1/0)", "é" * 5000, "&LOOP", "~X", "*", "&", "%A%", "END", "\\"] * 2:
        try:
            w.run(text)
        except windlass.Error:
            pass
    with pytest.raises(TypeError):
        w.run(3)
    with pytest.raises(windlass.RecordError, match="no/such"):
        w.load("/no/such/file.cif")


def test_warnings_are_warnings_of_python(chain):
    with pytest.warns(windlass.RecordWarning) as said:
        made = chain.run("MEDIT\n~V B_CAT 100 -LEN 300 -WTPLEN 1 -B_TENSION 50 -DEPANCHOR 100\nCONNECTOR B -ANC 90 250 ~V *F\nEND\n&STATUS F_CONNECTOR")
    assert any("beyond its breaking tension" in str(one.message) for one in said)
    assert made.over_break and any(made.over_break[0] in str(one.message) for one in said)
    assert {message.severity for message in made.messages} >= {"warning"} and "C O N N E C T O R" in made.text


def test_menus_variables_and_results_stay_between_calls(chain):
    chain.run("MEDIT")
    assert chain.menu == "MEDIT"
    chain.run("END\n&RESULT MINE 2.5 -UNIT kN")
    assert chain.results == {"MINE": (2.5, "kN")}
    assert chain.run("&FINISH\n&SET B = 1").finished
    assert chain.variable("B") is None


def test_control_c_stops_a_run(chain):
    def press():
        time.sleep(0.3)
        _thread.interrupt_main()

    thread = threading.Thread(target=press)
    thread.start()
    with pytest.raises(KeyboardInterrupt):
        chain.run("&LOOP I 1 100000000\n&SET A = %I%\n&ENDLOOP")
    thread.join()
    chain.run("&SET C = 3")
    assert chain.variable("C") == "3"


def test_session_is_of_one_thread_at_a_time(chain):
    said = []
    running = threading.Thread(target=lambda: chain.run("&LOOP I 1 20000\n&SET A = %I%\n&ENDLOOP"))
    running.start()
    while running.is_alive() and not said:
        try:
            chain.units
        except RuntimeError as error:
            said.append(str(error))
    running.join()
    assert not said or "another thread" in said[0]


def test_plots_pictures_and_films_are_shown_inline(chain, table):
    plot = chain.plot("Force", "Ten Top")
    assert plot._repr_svg_().startswith("<svg") and "Ten Top" in plot.text
    assert "Ten Top" in chain.plot().text and "Crit. Seg" not in chain.plot().text
    picture = chain.picture()
    assert picture._repr_svg_().startswith("<svg") and "BUOY" in picture.text
    assert chain.picture("iso", angle=30.0).text != picture.text
    with pytest.raises(ValueError, match="plan, elevation, iso"):
        chain.picture("above")
    with pytest.raises(windlass.Error, match="TDOM makes one"):
        chain.film()
    chain.run("&ENV -TIME 2 0.1\n&INSTATE -LOCATE BUOY 1\nTDOM")
    film = chain.film()
    assert film._repr_html_().startswith("<iframe") and "BUOY" in film.html
    with pytest.raises(KeyError, match="did you mean Force"):
        table.plot("Forse")


def test_html_of_a_table_is_escaped_and_short(w):
    w.run('&DIMEN -DIMEN METERS K-NTS\n&TITLE <script>alert(1)</script>')
    made = w.run("&STATUS ENVIRONMENT")
    assert "<script>" not in made._repr_html_()
    for table in made.tables:
        assert "<script>" not in table._repr_html_()


def test_files_go_to_the_folder_of_answers(tmp_path, table, chain):
    chain.run("&PICTURE PLAN -FILE plan.svg")
    assert (tmp_path / "job.ans" / "plan.svg").read_text().startswith("<svg")
    table.plot("Force", "Ten Top").save(tmp_path / "plot.svg")
    assert (tmp_path / "plot.svg").read_text().startswith("<svg")
    with pytest.raises(windlass.Error, match="nowhere"):
        table.plot("Force").save(tmp_path / "nowhere" / "plot.svg")


def test_scripts_are_loaded(tmp_path):
    (tmp_path / "model.cif").write_text(CHAIN + "&STATUS F_CONNECTOR\n")
    w = windlass.Session(tmp_path / "model")
    made = w.load(tmp_path / "model.cif")
    assert len(made.tables) == 1 and w.table()["Name"][0] == "A"


def test_cell_magic_runs_records():
    shell = pytest.importorskip("IPython.core.interactiveshell").InteractiveShell.instance()
    shell.run_line_magic("load_ext", "windlass")
    made = shell.run_cell_magic("windlass", "", CHAIN)
    assert isinstance(made, windlass.Result) and isinstance(shell.user_ns["w"], windlass.Session)
    shell.run_cell_magic("windlass", "other", "&SET A = 5")
    assert shell.user_ns["other"].variable("A") == "5"
    shell.user_ns["w"] = 3
    with pytest.raises(TypeError, match="no windlass.Session"):
        shell.run_cell_magic("windlass", "", "&SET A = 1")


def test_module_is_the_program(tmp_path):
    program = [sys.executable, "-m", "windlass"]
    done = subprocess.run([*program, "--version"], capture_output=True, text=True, check=True)
    assert done.stdout.startswith("windlass ")
    wrong = subprocess.run([*program, "-c", "NONSENSE"], capture_output=True, text=True, cwd=tmp_path)
    assert wrong.returncode == 1 and "NONSENSE" in wrong.stderr


def test_ensembles_of_a_study_are_read_with_fits_of_scipy(tmp_path):
    # maxima and scipy's fits of them: crates/signal/tests/data/ensemble.py and .csv
    data = Path(__file__).resolve().parents[2] / "crates/signal/tests/data/ensemble.csv"
    row = next(line for line in data.read_text().splitlines() if line.startswith("tension10,"))
    scipy = [float(cell) for cell in row.split(",")[1:]]
    maxima = [5210.0, 4987.5, 5534.2, 5105.8, 5078.4, 5391.0, 5640.7, 5012.3, 5166.9, 5288.6]
    (tmp_path / "cases.csv").write_text("case,member\n" + "".join(f"storm{n},{n}\n" for n in range(1, 11)))
    tokens = " ".join(map(str, maxima))
    (tmp_path / "model.cif").write_text(f"&SET T = &TOKEN(%MEMBER% {tokens})\n&RESULT T %T% -UNIT kN\n")
    made = windlass.study.run(tmp_path / "cases.csv", tmp_path / "model.cif", tmp_path / "out", jobs=1)
    ensembles = made.ensembles
    assert ensembles["result"].tolist() == ["T"] and ensembles["unit"].tolist() == ["kN"]
    assert ensembles["count"].tolist() == [10] and ensembles["largest"].tolist() == [5640.7]
    found = [ensembles[name][0] for name in ("mean", "standard_deviation", "moments_location", "moments_scale")]
    assert np.allclose(found, scipy[1:5], rtol=1e-9)
    assert ensembles["moments_mpm_low"][0] < ensembles["moments_mpm"][0] < ensembles["moments_mpm_high"][0]
    assert np.isclose(ensembles["likelihood_location"][0], scipy[5], rtol=1e-6)
    assert len(ensembles.to_pandas()) == 1
    # without two cases of one sea there is none
    (tmp_path / "one.csv").write_text("case,member\nstorm1,1\n")
    alone = windlass.study.run(tmp_path / "one.csv", tmp_path / "model.cif", tmp_path / "alone")
    assert len(alone.results) == 1 and alone.ensembles.names == []


def test_study_is_run_and_read_as_tables(tmp_path):
    (tmp_path / "cases.csv").write_text("case,DIST\nnear,200\nfar,250\nwrong,abc\n")
    (tmp_path / "model.cif").write_text(CHAIN.replace("-ANC 0 250", "-ANC 0 %DIST%") + "&RESULT TWICE 2*%DIST% -UNIT m\n")
    made = windlass.study.run(tmp_path / "cases.csv", tmp_path / "model.cif", tmp_path / "out", jobs=1)
    results = made.results
    assert results["case"].tolist() == ["near", "far", "wrong"]
    assert results["status"].tolist()[:2] == ["done", "done"] and results["status"][2] == "failed"
    assert results["TWICE"].tolist()[:2] == [400.0, 500.0] and np.isnan(results["TWICE"][2])
    assert results.units["TWICE"] == "m" and "1 failed" in made.summary
    assert windlass.study.read(tmp_path / "out").results.names == results.names
    with pytest.raises(windlass.Error, match="no script"):
        windlass.study.run(tmp_path / "cases.csv", tmp_path / "none.cif", tmp_path / "two")
    with pytest.raises(windlass.Error):
        windlass.study.read(tmp_path / "nothing")

"use strict";
// a click on a head sorts a table by its column; a second one the other way
for (const table of document.querySelectorAll("table")) {
  const heads = [...table.tHead.rows[0].cells];
  const body = table.tBodies[0];
  heads.forEach((head, at) => {
    if ([...body.rows].some(row => row.cells[at].dataset.n !== undefined)) head.className = "numbers";
    for (const row of body.rows) {
      if (row.cells[at].textContent.length > 60) row.cells[at].classList.add("long");
    }
    head.firstElementChild.addEventListener("click", () => {
      const down = head.getAttribute("aria-sort") === "ascending";
      const key = row => {
        const cell = row.cells[at];
        return cell.dataset.n === undefined ? cell.textContent : Number(cell.dataset.n);
      };
      const order = (a, b) => {
        // numbers before texts, and what is empty last either way
        if (a === b) return 0;
        if (a === "" || b === "") return a === "" ? 1 : -1;
        if (typeof a !== typeof b) return typeof a === "number" ? -1 : 1;
        const less = typeof a === "number" ? a - b : a.localeCompare(b, "en", { numeric: true });
        return down ? -less : less;
      };
      const rows = [...body.rows].map(row => [key(row), row]);
      rows.sort((a, b) => order(a[0], b[0]));
      body.append(...rows.map(pair => pair[1]));
      heads.forEach(other => other.removeAttribute("aria-sort"));
      head.setAttribute("aria-sort", down ? "descending" : "ascending");
    });
  });
}

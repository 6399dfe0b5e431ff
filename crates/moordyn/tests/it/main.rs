//! Decks of the form of MoorDyn's and MoorPy's own documents.

#![allow(clippy::unwrap_used)]

mod bad_input;
mod decks;
mod files;
mod map;

/// A deck with one line, in the columns of version 2.
pub(crate) const SINGLE_LINE: &str = "\
--------------------- MoorDyn Input File ------------------------
One chain
---------------------- LINE TYPES -------------------------------
TypeName   Diam    Mass/m     EA     BA/-zeta    EI    Cd   Ca   CdAx  CaAx
(name)     (m)     (kg/m)     (N)    (N-s/-)   (N-m^2) (-)  (-)  (-)   (-)
chain      0.1384  182.3      8.2e8  -0.8        0     1.33 1.0  0.4   0.5
---------------------- POINTS ------------------------------------
ID  Attachment  X     Y     Z    Mass  Volume CdA  Ca
(#) (word/ID)  (m)   (m)   (m)   (kg)  (m^3)  (m^2) (-)
1   Fixed      800    0    -200   0     0      0    0
2   Coupled    40     0    -14    0     0      0    0   # fairlead
---------------------- LINES -------------------------------------
ID  LineType  AttachA  AttachB  UnstrLen  NumSegs  LineOutputs
(#)  (name)    (#)      (#)       (m)      (-)      (-)
1    chain      1        2        850       50       pt
---------------------- OPTIONS -----------------------------------
200     WtrDpth
1e6     kBot
0.002   dtM      time step
---------------------- OUTPUTS -----------------------------------
FairTen1 AnchTen1
--------------------- need this line ------------------------------
";

pub(crate) fn read(text: &str) -> windlass_moordyn::Reading {
    windlass_moordyn::read(text, windlass_base::span::SourceId::new(0))
}

# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Table of `core.emissivity.random_surface`, by tools/tables/make_emission_table.py."""

SIGMA = (0, 2.5, 5, 10, 15, 20, 25, 30, 35, 40, 45, 50, 55, 60, 65)
POLAR = (0, 10, 20, 30, 40, 50, 60, 68, 75, 80, 84, 87, 89)
STEP = 0.0001
PACKED = (
    "c-muTMgn|DfY%fbj16@PVIV&%C1xK4?A^I}_58_VARsEj&;IBA{WF!7l@%4`MVZmw7K-c-f#Ck_i-*?FY)Ezv3=9nLaWR%"
    "-d3kDO%h97p5A9k#sVu~Z|Ji;A2YV|W(XW?QHb?2R95}FV^Srt+oxhismN>Y&I_UB}+u9bO^lnGPmCGkqH3mvPURi9-aDp"
    "2NaB0JVj<&{fI9NQpHwOx`l0zNTbHN}dBiciY_3j)Xm_2K9Q>uf|oq0cj;K#>%dwW8JkLH$_mzNd9nKSOp7Tf3`D=RC-^="
    "xUx_o*6Nj2=CDcztWB*lL}P#tS9Sojbj`Txzyh-KUs?S`QvvU+QsEqwTVB&kZRF35Jy_4SSi)TaNuP>}dBtD&mthb;}cB%"
    "Pc`8AmEGuPPQyC!2I{aEn5h%vCtL&diEX|+_|!EUY_Bn8$fXV^0Ac_mT#u$8v=oz;@?Ag{EHO&Zr{Fr>+Gt;|MkDp_c6SB"
    "_3H8A8m5xtGV#;4M@L6G{i;6lN6a!Rw#3%foT1^!*^AqEteP=#)vC#IA-;mw+hcU@_io)<y0}JVhUNm#H$^Pdr~FtVoZS0"
    "BrJphLzc3OI@`eE)A8%JxC{R<8<NwwP0Ua&naps(vAdrz7<0SiRLF8r-SU0c6`R4-bW1!$IN;3c0C%=#@5g1ELr)CMxW=Y"
    "@mRWd0lDbnDk^Nf>!W%V^TY*^oKG<p4=rL!ld2CrYgEPBh){_wxY8?2b8PA$1~r0{;&c8_beOO`Elk!(MB;N>shxkvc3({"
    "jpP|MbQxOUWrzqPW@z4t#xFHDEwpLFh+66m-?5*zlErL1BiU#)p-O$AIAI!Hs<(oa;R=PXdCzx*+c5=G)|o&!0bkcJBnU{"
    "i^NP`3+~ynl&Mfuk`p=b(dhzzkh$<uD<#4*Zqr!C)bIK^BojddbZM&?_imYiV9P-`<tMH(o1!F-{$9YT`^CMtf)I7s8`(I"
    ")lzM7H%{@^kv&^D7$^mdFo43r08B7|!U1t11p$-`D;K~VNcx0wVaXNDCDm<cmNGFS6+v*LA;z;o0V^vj3kwGbu(Pv+`J4~"
    "{5@2J4mIPd2E-wi1@Ibf%0s{Q}d_X=o7bmBXkPtBE0l6SqVjK$OU<n<lOIhK71?o1C<AAPV<$?fCgmXX+0J?w!ob`b&-~%"
    "~G6bM9wg&;1H1Of?hF%X}hPfkuwRz_M<LQE9MRZ&q^Qk0jKmXZ(`6(%ltkzI`(qRfa81qUfS5J92H0|8)ng2D|Fa-g6R0R"
    "c3Jih}v_^725JN=bqoE~uuarm75ashFs~zMhVjI)pDtJy)|KT+NB@YEFo&1)%Yb;%X@=DM?Ux0-Y(qub`kHF9!`@L3MR?R"
    "TU)#Igl?z4Gi>kwKddKz`g(gj#8=n"
)

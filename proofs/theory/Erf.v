(** * The error function

    Claim.  erf(x) = 2/sqrt(pi) int_0^x exp(-u^2) du has the derivative
    2/sqrt(pi) exp(-x^2), is odd, and vanishes at 0.

    Why.  Cases with a Gaussian in them have their closed forms in erf, which Coq's
    library does not have. *)

From Coq Require Import Reals.
From Coquelicot Require Import Coquelicot.
Open Scope R_scope.

Definition gaussian (u : R) : R := exp (- u ^ 2).
Definition erf (x : R) : R := 2 / sqrt PI * RInt gaussian 0 x.

Lemma gaussian_continuous (x : R) : continuous gaussian x.
Proof.
  apply (ex_derive_continuous (V := R_NormedModule)). unfold gaussian. now auto_derive.
Qed.

Lemma gaussian_integrable (a b : R) : ex_RInt gaussian a b.
Proof.
  apply (ex_RInt_continuous (V := R_CompleteNormedModule)). intros x _. apply gaussian_continuous.
Qed.

Theorem is_derive_erf (x : R) : is_derive erf x (2 / sqrt PI * gaussian x).
Proof.
  apply (is_derive_scal (RInt gaussian 0)), (is_derive_RInt gaussian _ 0).
  - exists (mkposreal 1 Rlt_0_1). intros y _.
    apply (RInt_correct (V := R_CompleteNormedModule)), gaussian_integrable.
  - apply gaussian_continuous.
Qed.

Theorem erf_0 : erf 0 = 0.
Proof. unfold erf. rewrite RInt_point. apply Rmult_0_r. Qed.

Theorem erf_opp (x : R) : erf (- x) = - erf x.
Proof.
  unfold erf. rewrite Ropp_mult_distr_r. f_equal.
  replace (- x) with (-1 * x + 0) by ring. replace 0 with (-1 * 0 + 0) at 1 by ring.
  rewrite <- (RInt_comp_lin gaussian) by apply gaussian_integrable.
  rewrite (RInt_ext _ (fun u => scal (-1) (gaussian u))).
  - rewrite (RInt_scal (V := R_CompleteNormedModule) gaussian) by apply gaussian_integrable.
    unfold scal; simpl; unfold mult; simpl. ring.
  - intros u _. f_equal. unfold gaussian. f_equal. ring.
Qed.

(** What [auto_derive] knows erf by. *)
Global Instance UnaryDiff_erf : UnaryDiff erf.
Proof. exists (fun x => 2 / sqrt PI * exp (- x ^ 2)). apply is_derive_erf. Defined.

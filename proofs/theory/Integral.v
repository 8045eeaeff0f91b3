(** * The volume rendering integral, and why manufactured cases are exact

    Claim.  Choose an optical depth t and a radiance I with t(0) = I(0) = 0.
    If t' = tau and I' = C tau exp(-t) along the ray, then t is the optical
    depth and I is the volume rendering integral

      I(D) = int_0^D C(s(l)) tau(s(l)) exp(- int_0^l tau(s(u)) du) dl.

    So two derivatives and two values at 0, which a computer algebra can check,
    amount to a statement about integrals.

    Source.  The integral is equation 1 of Etiene, Kirby and Silva, "A Study Of
    Discretization Errors In Volume Rendering Integral Approximations" (low
    albedo model of Max 1995).  The paper uses such a case without a proof.

    Assumptions.  tau(s(l)) and C(s(l)) tau(s(l)) are continuous on [0, D], and
    t and I have two-sided derivatives there, ends included.  Nothing is assumed
    about signs.  Coquelicot's [RInt] gives a value to every function, integrable
    or not, so each claim comes twice: [is_RInt] says that the Riemann integral
    exists and what it is, [_eq] restates that as an equation. *)

From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
Open Scope R_scope.

Section Definitions.
(** The field s along the ray, and the transfer functions tau and C over s. *)
Variables field extinction emission : R -> R.

Definition extinction_along (l : R) : R := extinction (field l).
Definition source (l : R) : R := emission (field l) * extinction (field l).
Definition optical_depth (l : R) : R := RInt extinction_along 0 l.
Definition transmittance (l : R) : R := exp (- optical_depth l).
Definition integrand (l : R) : R := source l * transmittance l.
Definition radiance (D : R) : R := RInt integrand 0 D.

(** What makes [t] and [I] the depth and radiance of a case of length [D]. *)
Record manufactured (t I : R -> R) (D : R) : Prop := {
  extinction_continuous : forall l, 0 <= l <= D -> continuous extinction_along l;
  source_continuous : forall l, 0 <= l <= D -> continuous source l;
  depth_derivative : forall l, 0 <= l <= D -> is_derive t l (extinction_along l);
  radiance_derivative : forall l, 0 <= l <= D -> is_derive I l (source l * exp (- t l));
  depth_at_0 : t 0 = 0;
  radiance_at_0 : I 0 = 0 }.
End Definitions.

(** The fundamental theorem of calculus, for a primitive that vanishes at 0. *)
Lemma integral_of_derivative (F f : R -> R) (b : R) :
  0 <= b -> F 0 = 0 ->
  (forall x, 0 <= x <= b -> is_derive F x (f x)) ->
  (forall x, 0 <= x <= b -> continuous f x) ->
  is_RInt f 0 b (F b).
Proof.
  intros Hb HF0 HF Hf.
  replace (F b) with (minus (F b) (F 0)).
  - apply (is_RInt_derive F f); intros x; rewrite Rmin_left, Rmax_right by lra; auto.
  - rewrite HF0. apply Rminus_0_r.
Qed.

Lemma continuous_exp_opp (f : R -> R) (x df : R) :
  is_derive f x df -> continuous (fun y => exp (- f y)) x.
Proof.
  intros Hf. apply (ex_derive_continuous (V := R_NormedModule)).
  auto_derive. now exists df.
Qed.

Section Soundness.
Variables field extinction emission t I : R -> R.
Variable D : R.
Hypothesis case : manufactured field extinction emission t I D.

Theorem manufactured_optical_depth (l : R) :
  0 <= l <= D -> is_RInt (extinction_along field extinction) 0 l (t l).
Proof.
  intros Hl. destruct case as [tau_continuous _ t_derivative _ t_0 _].
  apply integral_of_derivative; try lra; intros x Hx.
  - apply t_derivative. lra.
  - apply tau_continuous. lra.
Qed.

Corollary manufactured_optical_depth_eq (l : R) :
  0 <= l <= D -> optical_depth field extinction l = t l.
Proof. intros Hl. now apply is_RInt_unique, manufactured_optical_depth. Qed.

Theorem manufactured_radiance (l : R) :
  0 <= l <= D -> is_RInt (integrand field extinction emission) 0 l (I l).
Proof.
  intros Hl.
  apply is_RInt_ext with (fun x => source field extinction emission x * exp (- t x)).
  - intros x. rewrite Rmin_left, Rmax_right by lra. intros Hx.
    unfold integrand, transmittance. rewrite manufactured_optical_depth_eq; lra.
  - destruct case as [_ source_continuous t_derivative I_derivative _ I_0].
    apply integral_of_derivative; try lra; intros x Hx.
    + apply I_derivative. lra.
    + apply (continuous_mult (source field extinction emission)).
      * apply source_continuous. lra.
      * apply continuous_exp_opp with (extinction_along field extinction x).
        apply t_derivative. lra.
Qed.

Corollary manufactured_radiance_eq (l : R) :
  0 <= l <= D -> radiance field extinction emission l = I l.
Proof. intros Hl. now apply is_RInt_unique, manufactured_radiance. Qed.

(** Both at once, for rays that end anywhere before D: what the program states of a case. *)
Theorem manufactured_integrals (l : R) :
  0 <= l <= D ->
  is_RInt (extinction_along field extinction) 0 l (t l) /\
  is_RInt (integrand field extinction emission) 0 l (I l).
Proof. intros Hl. split; [now apply manufactured_optical_depth | now apply manufactured_radiance]. Qed.
End Soundness.

Arguments manufactured_integrals : clear implicits.

Arguments manufactured_optical_depth {field extinction emission t I D} case [l].
Arguments manufactured_optical_depth_eq {field extinction emission t I D} case [l].
Arguments manufactured_radiance {field extinction emission t I D} case [l].
Arguments manufactured_radiance_eq {field extinction emission t I D} case [l].
